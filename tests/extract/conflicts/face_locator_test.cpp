#include "extract/conflicts/face_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>

#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

bool meet(const Box& a, const Box& b) {
  for (int i = 0; i < 3; ++i)
    if (a.lo[i] > b.hi[i] || b.lo[i] > a.hi[i]) return false;
  return true;
}

/// Compares with all faces, for random boxes in lattice space. \returns the number of faces found.
std::size_t compareWithAllFaces(const UncertifiedMesh& input, std::mt19937& random, double extent) {
  const FaceTests& faces = input.working.faces();
  const std::vector<EdgeRef> active = input.active(), edges = input.edges();
  const FaceLocator locator(faces, active, {});
  std::vector<Box> boxes;
  for (const EdgeRef& e : edges)
    boxes.push_back(locator.latticeBox(Float4Box(faces.corners(faces.edgeCells().vertices(e)))));
  std::uniform_real_distribution<double> corner(-1, extent), size(0, 2);
  std::size_t count = 0;
  std::vector<EdgeRef> found;
  for (int round = 0; round < 200; ++round) {
    const Vec3d lo{corner(random), corner(random), corner(random)};
    const Box box{lo, lo + Vec3d{size(random), size(random), size(random)}};
    locator.facesAbout(box, found);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "a face was found twice";
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool there = std::binary_search(found.begin(), found.end(), edges[i]);
      EXPECT_TRUE(there || !meet(boxes[i], box)) << "face " << i << " was not found";
      if (!there) continue;
      ++count;
      const Vec3d low = faces.edgeCells().lowEnd(edges[i]);
      const double reach = std::max(1.0, locator.farReach(edges[i]));
      const Vec3d most{reach, reach, reach};
      EXPECT_TRUE(meet({low - most, low + most}, box)) << "face " << i << " is out of reach";
    }
  }
  return count;
}

TEST(FaceLocator, FindsTheFacesThatMayReachIntoABox) {
  std::mt19937 random(21);
  // Across the borders of blocks.
  const SignSource noisy = randomGrid(random, 14, false);
  EXPECT_GT(compareWithAllFaces(UncertifiedMesh(noisy, 0.02), random, 17), 2000U);
  const FieldSource creased = creasedSolid(24);
  EXPECT_GT(compareWithAllFaces(UncertifiedMesh(creased, 0), random, 25), 500U);
}

TEST(FaceLocator, KnowsHowFarFacesReach) {
  std::mt19937 random(22);
  const SignSource source = randomGrid(random, 6, false);
  const UncertifiedMesh input(source, 0.02);
  const FaceTests& faces = input.working.faces();
  const std::vector<EdgeRef> active = input.active();
  const std::vector<EdgeRef> some(active.begin(), active.begin() + static_cast<std::ptrdiff_t>(active.size() / 2));
  const FaceLocator locator(faces, some, {});
  for (const EdgeRef& e : input.edges()) {
    const double reach = locator.farReach(e);
    if (!std::binary_search(some.begin(), some.end(), e)) {
      EXPECT_LT(reach, 0);
      continue;
    }
    EXPECT_GE(reach, 1);
    for (const Vec3f& corner : faces.corners(faces.edgeCells().vertices(e)))
      EXPECT_LE(FaceLocator::distance(faces.edgeCells().lowEnd(e), locator.latticePosition(corner)), reach);
  }
}

TEST(FaceLocator, DistanceIsAlongTheLargestAxis) {
  EXPECT_EQ(FaceLocator::distance({1, 2, 3}, {1.5, 0, 4}), 2);
  EXPECT_EQ(FaceLocator::distance({1, 2, 3}, {1, 2, 3}), 0);
}

TEST(FaceLocator, LatticePositionsAreThoseOfTheMap) {
  const FieldSource source = creasedSolid(16);
  const UncertifiedMesh input(source, 0);
  const FaceLocator locator(input.working.faces(), {}, {});
  const Vec3d p{3, 4.5, 6.25};
  EXPECT_LT(length(locator.latticePosition(vecCast<float>(source.map().position(p))) - p), 1e-5);
}

TEST(FaceLocator, StopsWhenAsked) {
  const SignSource source = singlePoint();
  const UncertifiedMesh input(source);
  const std::atomic<bool> stop{true};
  EXPECT_THROW(FaceLocator(input.working.faces(), input.edges(), {.progress = {}, .stop = &stop}), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
