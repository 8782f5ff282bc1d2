#include "mesh/triangle_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <cmath>
#include <utility>

#include "mesh/faces.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 4096;

/// A triangle on its way to its place.
struct Item {
  std::uint64_t key;
  std::uint32_t triangle;
  friend bool operator<(const Item& a, const Item& b) {
    return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
  }
};
using Items = std::span<Item>;

constexpr int kCurveBits = 19;  // per axis
constexpr int kClassShift = 3 * kCurveBits;
constexpr int kLastClass = (1 << (64 - kClassShift)) - 1;

/// Puts two zero bits between each and the next of the low 21 bits.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

double largestSide(const BoxF& box) {
  const Vec3d d = vecCast<double>(box.hi) - vecCast<double>(box.lo);
  return std::max({d.x, d.y, d.z});
}

/// Sorts triangles by size, the largest last, and those of about one size along a Morton curve.
class Sorter {
 public:
  explicit Sorter(const Mesh& mesh) : mMesh(mesh) {}

  void sort(Items items) const {
    double largest = 0;
    const BoxF around = summary(items, &largest);
    setKeys(items, around, [&](const BoxF& box) { return sizeClass(largestSide(box), largest); });
    tbb::parallel_sort(items.begin(), items.end());
    refine(items);
  }

 private:
  [[nodiscard]] BoxF box(const Item& item) const { return boxOf(corners(mMesh, triangle(mMesh, item.triangle))); }

  static Vec3f center(const BoxF& box) { return box.lo * 0.5f + box.hi * 0.5f; }

  /// The box of the centres, and the side of the largest triangle.
  BoxF summary(Items items, double* largest) const {
    using Summary = std::pair<BoxF, double>;
    const Summary all = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, items.size(), kGrain), Summary{BoxF::empty(), 0},
        [&](const auto& range, Summary sum) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const BoxF b = box(items[i]);
            sum.first.include(center(b));
            sum.second = std::max(sum.second, largestSide(b));
          }
          return sum;
        },
        [](Summary a, const Summary& b) {
          a.first.include(b.first);
          return Summary{a.first, std::max(a.second, b.second)};
        });
    *largest = all.second;
    return all.first;
  }

  /// One class for a factor of 16: few classes within a mesh of one kind, yet no box more than that too large. The
  /// large ones come last so that they are met by the many searches of small ones, which threads share.
  static std::uint64_t sizeClass(double side, double largest) {
    if (side == 0) return 0;
    const int below = (std::ilogb(largest) - std::ilogb(side)) / 4;
    return static_cast<std::uint64_t>(kLastClass - std::min(below, kLastClass));
  }

  template <typename Class>
  void setKeys(Items items, const BoxF& around, Class&& classOf) const {
    constexpr double kSteps = 1 << kCurveBits;
    const double side = largestSide(around);
    const double scale = side > 0 ? kSteps / side : 0;
    const auto step = [&](float x, float lo) {
      const double s = (static_cast<double>(x) - static_cast<double>(lo)) * scale;
      return spread(static_cast<std::uint64_t>(std::min(s, kSteps - 1)));
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items.size(), kGrain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const BoxF b = box(items[i]);
        const Vec3f c = center(b);
        items[i].key = classOf(b) << kClassShift | step(c.x, around.lo.x) << 2 | step(c.y, around.lo.y) << 1 |
                       step(c.z, around.lo.z);
      }
    });
  }

  /// Where a mesh is a speck in its box, because of a part that is far away, one step of the curve holds many
  /// triangles. They are sorted along a curve of their own.
  void refine(Items items) const {
    constexpr std::size_t kMany = 64;
    for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
      while (end < items.size() && items[end].key == items[begin].key) ++end;
      if (end - begin < kMany) continue;
      const Items crowd = items.subspan(begin, end - begin);
      double unused = 0;
      const BoxF around = summary(crowd, &unused);
      if (largestSide(around) == 0) continue;
      setKeys(crowd, around, [](const BoxF&) { return std::uint64_t{0}; });
      tbb::parallel_sort(crowd.begin(), crowd.end());
      refine(crowd);
    }
  }

  const Mesh& mMesh;
};

/// Boxes of kGroup consecutive things each, given the box of one.
template <std::size_t kGroup, typename BoxOfOne>
Buffer<BoxF> groupBoxes(std::size_t count, BoxOfOne&& boxOfOne) {
  Buffer<BoxF> boxes((count + kGroup - 1) / kGroup);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      boxes[i] = BoxF::empty();
      for (std::size_t k = kGroup * i; k < std::min(kGroup * (i + 1), count); ++k) boxes[i].include(boxOfOne(k));
    }
  });
  return boxes;
}

}  // namespace

BoxF boxOf(const TriangleCorners& t) {
  BoxF box{t[0], t[0]};
  box.include(t[1]);
  box.include(t[2]);
  return box;
}

TriangleTree::TriangleTree(const Mesh& mesh, Buffer<std::uint32_t> triangles) : mTriangles(std::move(triangles)) {
  if (mTriangles.empty()) return;
  {
    Buffer<Item> items(mTriangles.size());
    tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) { items[i] = {0, mTriangles[i]}; });
    Sorter(mesh).sort(items);
    tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) { mTriangles[i] = items[i].triangle; });
  }
  mLevels.push_back(groupBoxes<kLeaf>(
      mTriangles.size(), [&](std::size_t i) { return boxOf(corners(mesh, triangle(mesh, mTriangles[i]))); }));
  while (mLevels.back().size() > 1) {
    const Buffer<BoxF>& below = mLevels.back();
    mLevels.push_back(groupBoxes<kFan>(below.size(), [&](std::size_t i) { return below[i]; }));
  }
}

}  // namespace pdc::detail
