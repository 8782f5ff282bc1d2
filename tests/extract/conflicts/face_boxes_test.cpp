#include "extract/conflicts/face_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <random>
#include <set>

#include "extract/certify/uncertified_mesh.h"
#include "simd_levels.h"

namespace pdc::detail {
namespace {

Float4Box boxOf(const UncertifiedMesh& input, const EdgeRef& e) {
  const std::vector<Triangle> triangles = input.triangles(e);
  Float4Box box(input.working.faces().corners(triangles[0]));
  for (const Triangle& t : triangles) box.add(Float4Box(input.working.faces().corners(t)));
  return box;
}

std::vector<std::int32_t> allBlocks(const UncertifiedMesh& input) {
  std::vector<std::int32_t> blocks(input.blocks.coords.size());
  std::iota(blocks.begin(), blocks.end(), 0);
  return blocks;
}

/// Expects from the block of each face exactly those whose boxes meet its own. \returns how many pairs that were.
std::size_t expectAllThatMeet(const UncertifiedMesh& input, const FaceBoxes& boxes) {
  const std::vector<EdgeRef> edges = input.edges();
  std::size_t count = 0;
  for (const EdgeRef& e : edges) {
    const Float4Box box = boxOf(input, e);
    std::set<EdgeRef> found;
    FaceBoxes::About(boxes, e.block).forEach(box, [&](const EdgeRef& other, std::uint64_t face) {
      EXPECT_EQ(face, input.working.edgeCells().face(other));
      EXPECT_TRUE(found.insert(other).second) << "a face was found twice";
      return true;
    });
    std::set<EdgeRef> expected;
    for (const EdgeRef& other : edges)
      if (!box.apartFrom(boxOf(input, other))) expected.insert(other);
    EXPECT_EQ(found, expected);
    count += found.size();
  }
  return count;
}

TEST(FaceBoxes, FindTheFacesWhoseBoxesMeetABox) {
  std::mt19937 random(21);
  // Across the borders of blocks.
  const SignSource noisy = randomGrid(random, 10, false);
  const UncertifiedMesh noise(noisy, 0.02);
  FaceBoxes inNoise(noise.working.faces());
  inNoise.prepare(allBlocks(noise), {});
  EXPECT_GT(expectAllThatMeet(noise, inNoise), 10000U);

  const FieldSource source = creasedSolid(24);
  const UncertifiedMesh creased(source, 0);
  FaceBoxes atCreases(creased.working.faces());
  atCreases.prepare(allBlocks(creased), {});
  EXPECT_GT(expectAllThatMeet(creased, atCreases), 5000U);
}

TEST(FaceBoxes, FollowFacesThatChange) {
  const FieldSource source = creasedSolid(24);
  UncertifiedMesh input(source, 0);
  FaceBoxes boxes(input.working.faces());
  boxes.prepare(allBlocks(input), {});
  for (std::size_t i = 0; i < input.working.vertices().size(); ++i)
    for (std::size_t step = 0; step < i % 4; ++step) input.working.retract(i);
  std::vector<EdgeRef> changed = input.active();
  const std::vector<EdgeRef> edges = input.edges();
  for (std::size_t i = 0; i < edges.size(); i += 5) {
    input.working.fans().add(edges[i]);
    changed.push_back(edges[i]);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  boxes.update(changed, {});
  expectAllThatMeet(input, boxes);
}

TEST(FaceBoxes, TakeInFacesAsTheyAreWhenTheirBlocksAreAskedFor) {
  std::mt19937 random(22);
  const SignSource source = randomGrid(random, 10, false);
  UncertifiedMesh input(source, 0.02);
  FaceBoxes boxes(input.working.faces());
  const std::vector<std::int32_t> blocks = allBlocks(input);
  boxes.prepare(std::span(blocks).first(1), {});
  for (std::size_t i = 0; i < input.working.vertices().size(); ++i) input.working.retract(i);
  boxes.update(input.active(), {});
  for (const std::int32_t block : blocks) boxes.prepare({&block, 1}, {});
  expectAllThatMeet(input, boxes);
}

TEST(FaceBoxes, EndWhenTheVisitorHasEnough) {
  const SignSource source = singlePoint();
  const UncertifiedMesh input(source, 0.02);
  FaceBoxes boxes(input.working.faces());
  boxes.prepare(allBlocks(input), {});
  int calls = 0;
  FaceBoxes::About(boxes, 0).forEach(boxOf(input, input.edges()[0]), [&](const EdgeRef&, std::uint64_t) {
    ++calls;
    return false;
  });
  EXPECT_EQ(calls, 1);
}

TEST(FaceBoxes, StopWhenAsked) {
  const SignSource source = singlePoint();
  const UncertifiedMesh input(source, 0.02);
  std::atomic<bool> stop{true};
  FaceBoxes boxes(input.working.faces());
  EXPECT_THROW(boxes.prepare(allBlocks(input), {.progress = {}, .stop = &stop}), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
