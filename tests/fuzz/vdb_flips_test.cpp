#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <string>
#include <vector>

#include "fuzz/forked.h"
#include "fuzz/mutate.h"
#include "fuzz/targets.h"
#include "io/file/temporary_folder.h"
#include "pdc/io/vdb/vdb_reader.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kNone = openvdb::io::COMPRESS_NONE, kMask = openvdb::io::COMPRESS_ACTIVE_MASK,
                        kZip = openvdb::io::COMPRESS_ZIP, kBlosc = openvdb::io::COMPRESS_BLOSC;

/// A few leaves and tiles, with two inactive values besides the background.
template <typename Grid>
typename Grid::Ptr smallGrid(const std::string& name, bool half) {
  using Value = typename Grid::ValueType;
  const auto grid = Grid::create(Value(3));
  auto& tree = grid->tree();
  for (int i = 0; i < 300; ++i) tree.setValue(openvdb::Coord(i % 20, i / 20, i % 7), Value(i % 2));
  for (int i = 0; i < 40; ++i) tree.setValueOff(openvdb::Coord(i % 20, 30, i / 20), Value(i % 2));
  tree.addTile(1, openvdb::Coord(64, 64, 64), Value(1), true);
  tree.addTile(3, openvdb::Coord(-4096, 0, 0), Value(0), true);
  grid->setName(name);
  grid->setSaveFloatAsHalf(half);
  grid->insertMeta("note", openvdb::StringMetadata("text"));
  return grid;
}

/// One file for each way of storing values, small enough that damage hits all of its parts.
void writeFiles(const fs::path& folder) {
  openvdb::initialize();
  const auto write = [&](const char* name, std::uint32_t compression, const openvdb::GridCPtrVec& grids) {
    openvdb::io::File file((folder / name).string());
    file.setCompression(compression);
    file.write(grids);
  };
  write("0", kNone, {smallGrid<openvdb::FloatGrid>("f", false), smallGrid<openvdb::Vec3SGrid>("v", false)});
  write("1", kZip | kMask, {smallGrid<openvdb::DoubleGrid>("d", false)});
  const auto shared = smallGrid<openvdb::FloatGrid>("f", false);
  const auto instance = openvdb::FloatGrid::create(shared->treePtr());
  instance->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(9)), 0.5, 2.0, 1.0));
  write("2", kBlosc | kMask, {shared, instance});
  write("3", kBlosc | kMask, {smallGrid<openvdb::FloatGrid>("h", true), smallGrid<openvdb::Vec3SGrid>("v", true)});
  write("4", kMask,
        {smallGrid<openvdb::BoolGrid>("b", false), smallGrid<openvdb::Int64Grid>("l", false),
         smallGrid<openvdb::Vec3IGrid>("w", false), smallGrid<openvdb::Vec3DGrid>("e", false)});
  std::ostringstream stream;
  openvdb::io::Stream(stream).write(
      openvdb::GridCPtrVec{smallGrid<openvdb::Int32Grid>("i", false), smallGrid<openvdb::FloatGrid>("f", true)});
  writeContents(folder / "5", stream.str());
}
constexpr std::size_t kFiles = 6;

/// Lists all grids of a damaged file and reads each of them.
void readDamaged(const fs::path& path) {
  for (const VdbGridInfo& info : listVdbGrids(path))
    if (info.contourable) static_cast<void>(readVdbGrid(path, info.name));
  for (const VdbGridName& name : listVdbNames(path))
    if (name.sampled) static_cast<void>(readVdbAttribute(path, name.name));
}

std::vector<std::string> makeFiles(const TemporaryFolder& folder) {
  // In a child, because writing grids starts threads, which do not survive a fork.
  const ForkedResult written = runForked(1, 1, [&](std::size_t) { writeFiles(folder.path()); });
  EXPECT_EQ(written.successes, 1u) << written.failure;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < kFiles; ++i) files.push_back(contentsOf(folder / std::to_string(i)));
  return files;
}

TEST(VdbFlips, TwoThousandDamagedFilesGiveAGridOrAnError) {
  const TemporaryFolder folder;
  const std::vector<std::string> files = makeFiles(folder);

  const ForkedResult whole = runForked(kFiles, kFiles, [&](std::size_t i) { readDamaged(folder / std::to_string(i)); });
  ASSERT_EQ(whole.successes, kFiles) << whole.failure;

  constexpr std::size_t kAttempts = 2000, kPerChild = 250;
  const fs::path damaged = folder / "damaged.vdb";
  const ForkedResult result = runForked(kAttempts, kPerChild, [&](std::size_t i) {
    fs::remove(damaged);  // file systems flush a file that is overwritten
    writeContents(damaged, mutate(files[i % kFiles], static_cast<std::uint32_t>(i)));
    readDamaged(damaged);
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.successes + result.errors, kAttempts);
  EXPECT_GT(result.successes, kAttempts / 20) << "damage to values alone passes";
  EXPECT_GT(result.errors, kAttempts / 4);
}

TEST(VdbFlips, WhatIsReadFromDamagedFilesGivesSoundMeshes) {
  const TemporaryFolder folder;
  const std::vector<std::string> files = makeFiles(folder);
  constexpr std::size_t kAttempts = 300, kPerChild = 50;
  const ForkedResult result = runForked(
      kAttempts, kPerChild, [&](std::size_t i) { fuzzVdb(mutate(files[i % kFiles], static_cast<std::uint32_t>(i))); });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.successes, kAttempts / 20);
}

}  // namespace
}  // namespace pdc
