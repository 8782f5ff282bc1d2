#include "simplify/decimation/new_intersections.h"

#include <gtest/gtest.h>

#include <utility>

#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

/// Vertices of plate(4) by their place in fourths, and of another one above it.
std::uint32_t at(int x, int y) { return static_cast<std::uint32_t>(5 * y + x); }
std::uint32_t above(int x, int y) { return 25 + at(x, y); }

/// Two plates, 0.1 apart.
class Plates {
 public:
  explicit Plates(Mesh mesh = twoPlates()) : mMesh(std::move(mesh)) {
    surface.faces = mMesh.triangles;
    surface.frame = LocalFrame(mMesh, surface.faces);
    for (const Vec3f& p : mMesh.positions) surface.positions.push_back(surface.frame.local(p));
    surface.given = mMesh.positions;
    stars.build(surface.faces, surface.positions.size());
  }

  static Mesh twoPlates() {
    Mesh mesh = test::plate(4);
    const Mesh lower = mesh;
    for (Vec3f p : lower.positions) {
      p.z = 0.1F;
      mesh.positions.push_back(p);
    }
    for (const Triangle& t : lower.triangles) mesh.triangles.push_back({t[0] + 25, t[1] + 25, t[2] + 25});
    return mesh;
  }

  [[nodiscard]] ChosenCollapse collapse(std::uint32_t a, std::uint32_t b, const Vec3f& to) const {
    return {a, b, {surface.frame.local(to), 0, false}};
  }

  DecimatedSurface surface;
  VertexStars stars;

 private:
  Mesh mMesh;
};

using Ends = std::vector<std::uint32_t>;
Ends ends(const std::vector<ChosenCollapse>& all) {
  Ends a;
  for (const ChosenCollapse& c : all) a.push_back(c.a);
  return a;
}

constexpr Vec3f kLow{0.4F, 0.5F, 0.04F}, kThroughTheOther{0.4F, 0.5F, 0.14F};

TEST(NewIntersections, RefusesWhatGoesThroughAnotherSheet) {
  const Plates p;
  NewIntersections intersections(p.surface, {});
  std::vector<ChosenCollapse> low{p.collapse(at(1, 2), at(2, 2), kLow)};
  EXPECT_TRUE(intersections.takeOut(p.stars, low, {}).empty());
  EXPECT_EQ(ends(low), Ends{at(1, 2)});
  std::vector<ChosenCollapse> high{p.collapse(at(1, 2), at(2, 2), kThroughTheOther)};
  EXPECT_EQ(ends(intersections.takeOut(p.stars, high, {})), Ends{at(1, 2)});
  EXPECT_TRUE(high.empty());
}

TEST(NewIntersections, OfTwoThatMeetTheLaterOneWaits) {
  const Plates p;
  NewIntersections intersections(p.surface, {});
  // Each is free of the other sheet as it is, but they pass through each other.
  std::vector<ChosenCollapse> both{p.collapse(above(1, 2), above(2, 2), {0.4F, 0.5F, 0.03F}),
                                   p.collapse(at(1, 2), at(2, 2), {0.4F, 0.5F, 0.07F})};
  EXPECT_TRUE(intersections.takeOut(p.stars, both, {}).empty());
  EXPECT_EQ(ends(both), Ends{above(1, 2)});
}

TEST(NewIntersections, WhatWouldPassThroughFacesThatChangeWaits) {
  const Plates p;
  NewIntersections intersections(p.surface, {});
  std::vector<ChosenCollapse> both{p.collapse(above(1, 2), above(2, 2), {0.4F, 0.5F, 0.3F}),
                                   p.collapse(at(1, 2), at(2, 2), {0.4F, 0.5F, 0.11F})};
  EXPECT_TRUE(intersections.takeOut(p.stars, both, {}).empty());
  EXPECT_EQ(ends(both), Ends{above(1, 2)});
}

TEST(NewIntersections, SeesWhatWasAccepted) {
  Plates p;
  NewIntersections intersections(p.surface, {});
  const std::vector<ChosenCollapse> up{p.collapse(above(1, 2), above(2, 2), {0.4F, 0.5F, 0.3F})};
  intersections.accept(p.stars, up);
  std::vector<ChosenCollapse> next{p.collapse(at(1, 2), at(2, 2), kThroughTheOther)};
  EXPECT_TRUE(intersections.takeOut(p.stars, next, {}).empty());
  EXPECT_EQ(next.size(), 1U);
}

TEST(NewIntersections, AllowsWhatHasMetBefore) {
  Mesh mesh = Plates::twoPlates();
  mesh.positions[at(2, 2)].z = 0.15F;
  const Plates p(mesh);
  NewIntersections intersections(p.surface, {});
  std::vector<ChosenCollapse> high{p.collapse(at(2, 2), at(1, 2), {0.5F, 0.5F, 0.15F})};
  EXPECT_TRUE(intersections.takeOut(p.stars, high, {}).empty());
  EXPECT_EQ(high.size(), 1U);
  intersections.accept(p.stars, high);
  // It does not meet what is farther away, and must not come to.
  std::vector<ChosenCollapse> far{p.collapse(at(3, 3), at(2, 3), {0.7F, 0.75F, 0.15F})};
  EXPECT_EQ(intersections.takeOut(p.stars, far, {}).size(), 1U);
}

}  // namespace
}  // namespace pdc::detail
