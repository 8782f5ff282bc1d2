#include "pdc/tile/slab_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "extract/certify/uncertified_mesh.h"
#include "extract/turned_layer.h"
#include "io/file/temporary_folder.h"
#include "pdc/error.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "tile/slab_lock.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;
using Progress = SlabState::Progress;

std::string bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string refusalOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

void expectMentions(const std::string& text, const std::string& what) {
  EXPECT_NE(text.find(what), std::string::npos) << text;
}

class SlabFolderTest : public testing::Test {
 protected:
  [[nodiscard]] SlabFolder plan(const std::string& name, const ContourOptions& options = {}, int slabs = 3) {
    return SlabFolder::create(mFolder / name, planSlabs(mSource, options, {.slabs = slabs}), "a request");
  }
  void expectTheWhole(const SlabFolder& folder, const ContourOptions& options, const MeshWriteOptions& write = {}) {
    const Mesh whole = contour(mSource, options);
    writeMesh(whole, mFolder / "whole.ply", write);
    const SlabMergeReport report = mergeSlabs(folder, mFolder / "merged.ply", options.triangles, write);
    EXPECT_TRUE(bytesOf(mFolder / "merged.ply") == bytesOf(mFolder / "whole.ply"));
    EXPECT_EQ(report.vertices, whole.positions.size());
    EXPECT_EQ(report.quads, whole.quads.size());
    EXPECT_EQ(report.triangles, whole.triangles.size());
    EXPECT_EQ(report.bytesWritten, fs::file_size(mFolder / "whole.ply"));
  }
  /// Turns a byte of a slab's file.
  static void damage(const fs::path& path, std::size_t at) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(file.get() ^ 0x10);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte);
  }

  TemporaryFolder mFolder;
  const FieldSource mSource = detail::creasedSolid(64);  // In eight layers.
};

TEST_F(SlabFolderTest, SlabsAreJoinedToTheBytesOfTheWhole) {
  for (const int count : {1, 2, 8}) {
    const SlabFolder folder = plan(std::to_string(count), {}, count);
    EXPECT_EQ(runSlabs(folder, mSource, {}).contoured, static_cast<std::size_t>(count));
    expectTheWhole(folder, {});
  }
}

TEST_F(SlabFolderTest, OptionsAreThoseOfTheWhole) {
  const ContourOptions options{.triangles = true, .normals = true, .confidence = true, .ranks = true};
  const SlabFolder folder = plan("all", options);
  runSlabs(folder, mSource, {.contour = options});
  expectTheWhole(folder, options, {.space = "RAS", .unit = "mm"});
  expectTheWhole(folder, options, {.ascii = true});
  expectTheWhole(folder, options, {.doublePrecision = true});
}

TEST_F(SlabFolderTest, AnEmptySurfaceIsAnEmptyMesh) {
  const FieldSource nothing(sphere({9, 9, 9}, 0.5), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 0.1});
  const SlabFolder folder = SlabFolder::create(mFolder / "none", planSlabs(nothing, {}, {}), "");
  EXPECT_EQ(runSlabs(folder, nothing, {}).contoured, 0U);
  EXPECT_EQ(mergeSlabs(folder, mFolder / "none.ply", false).vertices, 0U);
  writeMesh(contour(nothing), mFolder / "whole.ply");
  EXPECT_EQ(bytesOf(mFolder / "none.ply"), bytesOf(mFolder / "whole.ply"));
}

TEST_F(SlabFolderTest, SlabsAreContouredInAnyOrderAndOnce) {
  const SlabFolder folder = plan("order", {}, 4);
  EXPECT_EQ(runSlabs(folder, mSource, {.first = 2, .last = 3}).contoured, 2U);
  EXPECT_EQ(slabStates(folder)[1].progress, Progress::kMissing);
  EXPECT_EQ(slabStates(folder)[2].progress, Progress::kDone);
  expectMentions(refusalOf([&] { mergeSlabs(folder, mFolder / "x.ply", false); }), "slab 0 is missing");
  EXPECT_FALSE(fs::exists(mFolder / "x.ply"));
  EXPECT_EQ(runSlabs(folder, mSource, {.onlyOne = true}).contoured, 1U);
  EXPECT_EQ(slabStates(folder)[0].progress, Progress::kDone);
  EXPECT_EQ(runSlabs(folder, mSource, {}).contoured, 1U);
  EXPECT_EQ(runSlabs(folder, mSource, {}).contoured, 0U);
  expectTheWhole(folder, {});
  expectMentions(refusalOf([&] { runSlabs(folder, mSource, {.first = 4}); }), "there are 4, from 0");
}

TEST_F(SlabFolderTest, AnothersSlabIsLeftToIt) {
  const SlabFolder folder = plan("others");
  {
    const auto lock = detail::SlabLock::take(folder.lockFile(1));
    ASSERT_TRUE(lock);
    const SlabRunReport report = runSlabs(folder, mSource, {});
    EXPECT_EQ(report.contoured, 2U);
    EXPECT_EQ(report.left, 1U);
    EXPECT_EQ(slabStates(folder)[1].progress, Progress::kRunning);
  }
  EXPECT_EQ(runSlabs(folder, mSource, {}).contoured, 1U);
  expectTheWhole(folder, {});
}

TEST_F(SlabFolderTest, WhatNeighboursDoNotAgreeOnIsRefusedAndContouredAgain) {
  const SlabFolder folder = plan("disputed");
  const Slab middle = folder.plan().slabs[1];
  runSlabs(folder, mSource, {.first = 0, .last = 0});
  runSlabs(folder, mSource, {.first = 2, .last = 2});
  // One layer that the slab below contours too, or the one above.
  for (const int layer : {middle.begin, middle.end - 1, middle.begin - 1, middle.end}) {
    fs::remove(folder.slabFile(1));
    runSlabs(folder, detail::TurnedLayer(mSource, layer), {.first = 1, .last = 1, .onlyOne = true});
    EXPECT_EQ(slabStates(folder)[1].progress, Progress::kDisputed) << "layer " << layer;
    expectMentions(refusalOf([&] { mergeSlabs(folder, mFolder / "x.ply", false); }), "do not agree");
  }
  EXPECT_FALSE(fs::exists(mFolder / "x.ply"));
  const SlabRunReport report = runSlabs(folder, mSource, {});
  EXPECT_GE(report.widened, 2U);
  expectTheWhole(folder, {});
}

TEST_F(SlabFolderTest, DamageIsNoticedAndMendedByAnotherRun) {
  const SlabFolder folder = plan("damaged");
  runSlabs(folder, mSource, {});
  std::mt19937 random(5);
  const std::size_t size = fs::file_size(folder.slabFile(1));
  for (int i = 0; i < 40; ++i) {
    const std::string before = bytesOf(folder.slabFile(1));
    damage(folder.slabFile(1), random() % size);
    const std::string refusal = refusalOf([&] { mergeSlabs(folder, mFolder / "x.ply", false); });
    EXPECT_TRUE(refusal.find("slab_00001") != std::string::npos || refusal.find("do not agree") != std::string::npos)
        << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
    std::ofstream(folder.slabFile(1), std::ios::binary) << before;
  }
  EXPECT_FALSE(fs::exists(mFolder / "x.ply"));
  for (const std::size_t left : {std::size_t{0}, std::size_t{5}, std::size_t{100}, size / 2, size - 1}) {
    fs::resize_file(folder.slabFile(1), left);
    expectMentions(refusalOf([&] { mergeSlabs(folder, mFolder / "x.ply", false); }), "slab_00001");
    EXPECT_EQ(runSlabs(folder, mSource, {}).contoured, 1U) << left;
  }
  expectTheWhole(folder, {});
}

TEST_F(SlabFolderTest, FilesOfOtherPlansAreRefused) {
  const SlabFolder folder = plan("one"), other = plan("other", {}, 2);
  runSlabs(folder, mSource, {});
  runSlabs(other, mSource, {});
  fs::copy_file(other.slabFile(1), folder.slabFile(1), fs::copy_options::overwrite_existing);
  expectMentions(refusalOf([&] { (void)slabStates(folder); }), "belongs to another plan");
  fs::copy_file(folder.slabFile(0), folder.slabFile(1), fs::copy_options::overwrite_existing);
  expectMentions(refusalOf([&] { (void)slabStates(folder); }), "belongs to another plan");
}

TEST_F(SlabFolderTest, PlansAreReadBackAndNeverReplaced) {
  const SlabFolder made = plan("again");
  const SlabFolder opened(mFolder / "again");
  EXPECT_EQ(opened.plan().slabs, made.plan().slabs);
  EXPECT_EQ(opened.request(), "a request");
  EXPECT_EQ(opened.hash(), made.hash());
  expectMentions(refusalOf([&] { (void)plan("again"); }), "holds a plan already");
  expectMentions(refusalOf([&] { SlabFolder(mFolder / "nowhere"); }), "holds no plan");
  std::ofstream(mFolder / "again" / "plan.json") << "{\"pdc_plan\": 1}";
  expectMentions(refusalOf([&] { SlabFolder(mFolder / "again"); }), "is damaged");
  std::ofstream(mFolder / "again" / "plan.json") << "{\"pdc_plan\": 7}";
  expectMentions(refusalOf([&] { SlabFolder(mFolder / "again"); }), "another version");
}

TEST_F(SlabFolderTest, AStoppedRunLeavesSlabsAsTheyWere) {
  const SlabFolder folder = plan("stopped");
  const std::atomic<bool> stop = true;
  EXPECT_THROW(runSlabs(folder, mSource, {}, {.progress = {}, .stop = &stop}), Cancelled);
  for (const SlabState& state : slabStates(folder)) EXPECT_EQ(state.progress, Progress::kMissing);
  runSlabs(folder, mSource, {});
  EXPECT_THROW(mergeSlabs(folder, mFolder / "x.ply", false, {}, {.progress = {}, .stop = &stop}), Cancelled);
  EXPECT_FALSE(fs::exists(mFolder / "x.ply"));
  expectTheWhole(folder, {});
}

TEST_F(SlabFolderTest, TheSameBytesForAnyNumberOfThreads) {
  std::string first;
  for (const int threads : {1, 2, 3, 8}) {
    const SlabFolder folder = plan("threads" + std::to_string(threads));
    runSlabs(folder, mSource, {.contour = {.threads = threads}});
    const std::string bytes = bytesOf(folder.slabFile(1));
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
}

}  // namespace
}  // namespace pdc
