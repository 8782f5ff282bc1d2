#include "mesh/triangle_forest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "mesh/faces.h"

namespace pdc::detail {
namespace {

/// Small triangles in the unit cube that share no vertices.
class Triangles {
 public:
  explicit Triangles(std::uint32_t count) : mesh{}, mPresent(count, true) {
    mesh.positions.resize(3 * count);
    for (std::uint32_t t = 0; t < count; ++t) {
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
      move(t);
    }
  }

  void move(std::uint32_t t) {
    std::uniform_real_distribution<float> place(0, 1), size(-0.1F, 0.1F);
    const Vec3f center{place(mRandom), place(mRandom), place(mRandom)};
    for (const std::uint32_t v : mesh.triangles[t])
      mesh.positions[v] = center + Vec3f{size(mRandom), size(mRandom), size(mRandom)};
    mPresent[t] = true;
  }
  void remove(std::uint32_t t) { mPresent[t] = false; }
  std::uint32_t any() { return std::uniform_int_distribution<std::uint32_t>(0, count() - 1)(mRandom); }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(mPresent.size()); }
  [[nodiscard]] BoxF box(std::uint32_t t) const { return boxOf(corners(mesh, mesh.triangles[t])); }

  [[nodiscard]] std::vector<std::uint32_t> meeting(const BoxF& with) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < count(); ++t)
      if (mPresent[t] && box(t).meets(with)) found.push_back(t);
    return found;
  }

  Mesh mesh;

 private:
  std::vector<bool> mPresent;
  std::mt19937 mRandom{5};
};

std::vector<std::uint32_t> meeting(const TriangleForest& forest, const Triangles& all, const BoxF& box) {
  std::vector<std::uint32_t> found;
  forest.visitMeeting(box, [&](std::uint32_t t) {
    if (all.box(t).meets(box)) found.push_back(t);
  });
  std::sort(found.begin(), found.end());
  return found;
}

TEST(TriangleForest, FindsTrianglesWhereTheyAreNow) {
  Triangles all(400);
  Buffer<std::uint32_t> numbers(all.count());
  std::iota(numbers.begin(), numbers.end(), 0U);
  TriangleForest forest(all.mesh, all.count(), numbers);
  std::mt19937 random(7);
  for (int round = 0; round < 60; ++round) {
    Buffer<std::uint32_t> changed;
    for (int i = 0; i < (round % 7 == 0 ? 150 : 5); ++i) {
      const std::uint32_t t = all.any();
      if (std::find(changed.begin(), changed.end(), t) != changed.end()) continue;
      forest.remove(t);
      // One in five goes for good, or until it is changed once more.
      if (random() % 5 == 0) {
        all.remove(t);
        continue;
      }
      all.move(t);
      changed.push_back(t);
    }
    forest.add(changed);
    for (std::uint32_t t = 0; t < all.count(); t += 37) {
      const BoxF box = all.box(t);
      ASSERT_EQ(meeting(forest, all, box), all.meeting(box)) << "round " << round << ", box " << t;
    }
  }
}

TEST(TriangleForest, MayBeEmpty) {
  const Triangles all(1);
  TriangleForest forest(all.mesh, 1, {});
  EXPECT_TRUE(meeting(forest, all, all.box(0)).empty());
  forest.add({});
  forest.add({0});
  EXPECT_EQ(meeting(forest, all, all.box(0)), std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace pdc::detail
