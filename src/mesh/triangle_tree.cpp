#include "mesh/triangle_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <cmath>
#include <functional>
#include <utility>

#include "mesh/faces.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 4096;

/// A triangle on its way to its place.
struct Item {
  std::uint64_t key;
  std::uint32_t hub, triangle;
  friend bool operator<(const Item& a, const Item& b) {
    if (a.key != b.key) return a.key < b.key;
    return a.hub != b.hub ? a.hub < b.hub : a.triangle < b.triangle;
  }
};
using Items = std::span<Item>;

constexpr int kCurveBits = 19;  // per axis
constexpr int kClassShift = 3 * kCurveBits;
constexpr int kSliverClass = 1 << (64 - kClassShift - 1);  // The first one for slivers and hubs.
constexpr int kLastClass = kSliverClass - 1;

bool isInSliverBranch(const Item& item) { return item.key >> kClassShift >= kSliverClass; }

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

/// Sorts triangles by size, the largest last, and those of about one size along a Morton curve. Slivers come after all
/// others. The triangles of a hub are sorted as one, and then along a curve of their own.
class Sorter {
 public:
  explicit Sorter(const Mesh& mesh) : mMesh(mesh) {}

  /// \returns how many items are neither slivers nor at hubs; these come first.
  std::size_t sort(Items items) const {
    const std::vector<BoxF> hubs = hubBoxes(items);
    const auto boxIn = [&](const Item& item) { return item.hub == kNoHub ? box(item) : hubs[item.hub]; };
    double largest = 0;
    const BoxF around = summary(items, boxIn, &largest);
    setKeys(items, around, boxIn, [&](const Item& item, const BoxF& box) {
      const bool sliver = item.hub != kNoHub || isSliver(corners(mMesh, triangle(mMesh, item.triangle)));
      return sizeClass(largestSide(box), largest) + (sliver ? kSliverClass : 0);
    });
    tbb::parallel_sort(items.begin(), items.end());
    const auto firstSliver = std::partition_point(items.begin(), items.end(), std::not_fn(isInSliverBranch));
    const auto plain = static_cast<std::size_t>(firstSliver - items.begin());
    refine(items);
    return plain;
  }

 private:
  [[nodiscard]] BoxF box(const Item& item) const { return boxOf(corners(mMesh, triangle(mMesh, item.triangle))); }

  static Vec3f center(const BoxF& box) { return box.lo * 0.5f + box.hi * 0.5f; }

  [[nodiscard]] std::vector<BoxF> hubBoxes(Items items) const {
    std::vector<BoxF> boxes;
    for (const Item& item : items) {
      if (item.hub == kNoHub) continue;
      if (item.hub >= boxes.size()) boxes.resize(item.hub + std::size_t{1}, BoxF::empty());
      boxes[item.hub].include(box(item));
    }
    return boxes;
  }

  /// The box of the centres of boxes, and the largest side of one.
  template <typename BoxIn>
  BoxF summary(Items items, const BoxIn& boxIn, double* largest) const {
    using Summary = std::pair<BoxF, double>;
    const Summary all = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, items.size(), kGrain), Summary{BoxF::empty(), 0},
        [&](const auto& range, Summary sum) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const BoxF b = boxIn(items[i]);
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
  static int sizeClass(double side, double largest) {
    if (side == 0) return 0;
    const int below = (std::ilogb(largest) - std::ilogb(side)) / 4;
    return kLastClass - std::min(below, kLastClass);
  }

  template <typename BoxIn, typename Class>
  void setKeys(Items items, const BoxF& around, const BoxIn& boxIn, Class&& classOf) const {
    constexpr double kSteps = 1 << kCurveBits;
    const double side = largestSide(around);
    const double scale = side > 0 ? kSteps / side : 0;
    const auto step = [&](float x, float lo) {
      const double s = (static_cast<double>(x) - static_cast<double>(lo)) * scale;
      return spread(static_cast<std::uint64_t>(std::min(s, kSteps - 1)));
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items.size(), kGrain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const BoxF b = boxIn(items[i]);
        const Vec3f c = center(b);
        items[i].key = static_cast<std::uint64_t>(classOf(items[i], b)) << kClassShift | step(c.x, around.lo.x) << 2 |
                       step(c.y, around.lo.y) << 1 | step(c.z, around.lo.z);
      }
    });
  }

  /// Sorts what has one place on the curve along a curve of its own: the triangles of a hub, and many triangles on one
  /// step, as there are where a mesh is a speck in its box because of a part that is far away.
  void refine(Items items) const {
    constexpr std::size_t kMany = 64;
    const auto boxIn = [&](const Item& item) { return box(item); };
    for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
      const Item& first = items[begin];
      while (end < items.size() && items[end].key == first.key && items[end].hub == first.hub) ++end;
      if (end - begin < kMany) continue;
      const Items crowd = items.subspan(begin, end - begin);
      double unused = 0;
      const BoxF around = summary(crowd, boxIn, &unused);
      if (largestSide(around) == 0) continue;
      setKeys(crowd, around, boxIn, [](const Item&, const BoxF&) { return 0; });
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

TriangleTree::TriangleTree(const Mesh& mesh, Buffer<std::uint32_t> triangles, std::span<const std::uint32_t> hubs,
                           float margin)
    : mTriangles(std::move(triangles)), mHubs(hubs.size()) {
  if (mTriangles.empty()) return;
  std::size_t plain = 0;
  {
    Buffer<Item> items(mTriangles.size());
    tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
      items[i] = {0, hubs.empty() ? kNoHub : hubs[i], mTriangles[i]};
    });
    plain = Sorter(mesh).sort(items);
    tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
      mTriangles[i] = items[i].triangle;
      if (!mHubs.empty()) mHubs[i] = items[i].hub;
    });
  }
  mLevels.push_back(groupBoxes<kLeaf>(mTriangles.size(), [&](std::size_t i) {
    const BoxF box = boxOf(corners(mesh, triangle(mesh, mTriangles[i])));
    const Vec3f beyond{margin, margin, margin};
    return BoxF{box.lo - beyond, box.hi + beyond};
  }));
  if (plain < mTriangles.size()) addSliverLeaves(mesh, plain, margin);
  while (mLevels.back().size() > 1) {
    const Buffer<BoxF>& below = mLevels.back();
    mLevels.push_back(groupBoxes<kFan>(below.size(), [&](std::size_t i) { return below[i]; }));
    if (mSlivers.size() == mLevels.size() - 1) addSliverLevel();
  }
}

void TriangleTree::addSliverLeaves(const Mesh& mesh, std::size_t firstTriangle, float margin) {
  const std::size_t first = (firstTriangle + kLeaf - 1) / kLeaf;
  SliverNodes slivers{first, Buffer<SliverNode>(leafCount() - first)};
  tbb::parallel_for(std::size_t{0}, slivers.nodes.size(), [&](std::size_t i) {
    std::array<Vec3d, 3 * kLeaf> points;
    std::size_t count = 0;
    TriangleCorners largest{};
    for (const std::uint32_t t : leaf(first + i)) {
      const TriangleCorners c = corners(mesh, triangle(mesh, t));
      if (count == 0 || largestSide(boxOf(c)) > largestSide(boxOf(largest))) largest = c;
      for (const Vec3f& p : c) points[count++] = vecCast<double>(p);
    }
    const auto hubs = leafHubs(first + i);
    const bool one = !hubs.empty() && std::all_of(hubs.begin(), hubs.end(), [&](auto hub) { return hub == hubs[0]; });
    slivers.nodes[i] = {OrientedBox(axesAlong(largest), std::span(points).first(count), static_cast<double>(margin)),
                        one ? hubs[0] : kNoHub};
  });
  mSlivers.push_back(std::move(slivers));
}

void TriangleTree::addSliverLevel() {
  const SliverNodes& below = mSlivers.back();
  const Buffer<BoxF>& boxes = mLevels.back();
  const std::size_t first = (below.first + kFan - 1) / kFan;
  if (first >= boxes.size()) return;
  SliverNodes level{first, Buffer<SliverNode>(boxes.size() - first)};
  tbb::parallel_for(std::size_t{0}, level.nodes.size(), [&](std::size_t i) {
    const std::size_t begin = kFan * (first + i) - below.first;
    const std::span children = std::span(below.nodes).subspan(begin, std::min(kFan, below.nodes.size() - begin));
    std::array<Vec3d, 8 * kFan> points;
    auto end = points.begin();
    std::uint32_t hub = children[0].hub;
    for (const SliverNode& child : children) {
      const auto corners = child.box.corners();
      end = std::copy(corners.begin(), corners.end(), end);
      if (child.hub != hub) hub = kNoHub;
    }
    const std::span used(points.begin(), end);
    const OrientedBox tilted(children[children.size() / 2].box.axes, used, 0), plain(boxes[first + i]);
    level.nodes[i] = {tilted.surface() < plain.surface() ? tilted : plain, hub};
  });
  mSlivers.push_back(std::move(level));
}

}  // namespace pdc::detail
