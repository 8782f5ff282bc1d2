#include "mesh/winding/solid_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/lane_loops.h"
#include "mesh/winding/lattice_line.h"

namespace pdc::detail {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;

/// Triangles this many of their radii away count together: their sum is then exact to 0.003 of a winding number.
constexpr double kFar = 3;

Vec3d areaVector(const std::array<Vec3d, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]) * 0.5; }
Vec3d middleOf(const std::array<Vec3d, 3>& t) { return (t[0] + t[1] + t[2]) * (1.0 / 3); }

/// Below this share of the lengths of three vectors rounding may turn the sign of their determinant.
constexpr double kUnsure = 1e-14;

struct Lanes {
  std::array<double, 8> v;
  double& operator[](int lane) { return v[static_cast<std::size_t>(lane)]; }
  double operator[](int lane) const { return v[static_cast<std::size_t>(lane)]; }
};

/// Points nearer to an edge, in its lengths, count as on it.
constexpr double kOnEdge = 1e-9;

/// How a triangle's solid angle changes: its edges, as wires with a current, by the law of Biot and Savart.
Vec3d gradientOf(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  const std::array<Vec3d, 3> r{t[0] - p, t[1] - p, t[2] - p};
  const std::array<double, 3> l{length(r[0]), length(r[1]), length(r[2])};
  Vec3d sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    // On an edge and at its ends the triangles around cancel; that their terms stay finite lets them do so.
    const double both = l[i] * l[k], flat = std::max(both + dot(r[i], r[k]), kOnEdge * both);
    if (std::min(l[i], l[k]) > kOnEdge * std::max(l[i], l[k]))
      sum += cross(r[i], r[k]) * ((l[i] + l[k]) / (both * flat));
  }
  return sum;
}

}  // namespace

SolidAngles::SolidAngles(const ClosedSurface& surface, std::vector<std::uint32_t> triangles)
    : mSurface(surface), mTriangles(std::move(triangles)) {
  if (mTriangles.empty()) return;
  mNodes.push_back({.first = 0, .count = static_cast<std::uint32_t>(mTriangles.size())});
  for (std::uint32_t node = 0; node < mNodes.size(); ++node) build(node);
}

void SolidAngles::build(std::uint32_t node) {
  summarise(mNodes[node]);
  const std::uint32_t first = mNodes[node].first, count = mNodes[node].count;
  if (count <= kLeaf) return fillLeaf(mNodes[node]);
  Box box = Box::empty();
  for (std::uint32_t i = first; i < first + count; ++i) box.include(middleOf(mSurface.points(mTriangles[i])));
  const Vec3d side = box.hi - box.lo;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : (side.y >= side.z ? 1 : 2);
  const auto begin = mTriangles.begin() + first, half = begin + count / 2;
  std::nth_element(begin, half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(middleOf(mSurface.points(a))[axis], a) < std::pair(middleOf(mSurface.points(b))[axis], b);
  });
  mNodes[node].child = static_cast<std::uint32_t>(mNodes.size());
  mNodes.push_back({.first = first, .count = count / 2});
  mNodes.push_back({.first = first + count / 2, .count = count - count / 2});
}

void SolidAngles::fillLeaf(Node& node) {
  node.leaf = static_cast<std::uint32_t>(mLeaves.size());
  Leaf& leaf = mLeaves.emplace_back();
  for (std::uint32_t i = 0; i < kLeaf; ++i) {
    const std::array<Vec3d, 3> t = mSurface.points(mTriangles[node.first + std::min(i, node.count - 1)]);
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        leaf.corner[corner][axis][i] = t[i < node.count ? corner : 0][static_cast<int>(axis)];
  }
}

void SolidAngles::summarise(Node& node) const {
  const auto forEach = [&](auto&& visit) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(mSurface.points(mTriangles[i]));
  };
  Box box = Box::empty();
  Vec3d places{};
  forEach([&](const std::array<Vec3d, 3>& t) {
    const Vec3d normal = areaVector(t);
    node.area += length(normal);
    node.normal += normal;
    places += middleOf(t) * length(normal);
    for (const Vec3d& p : t) box.include(p);
  });
  node.middle = node.area > 0 ? places * (1 / node.area) : box.center();
  forEach([&](const std::array<Vec3d, 3>& t) {
    const Vec3d normal = areaVector(t), place = middleOf(t) - node.middle;
    for (int k = 0; k < 3; ++k) node.moment.row[k] += normal * place[k];
    for (const Vec3d& p : t) node.radius = std::max(node.radius, length(p - node.middle));
  });
}

/// Angles added as arguments of a product, so that all of them take one arc tangent. Real parts stay positive: what has
/// a negative one is turned by half a circle, which is counted.
class SolidAngles::Turns {
 public:
  /// Adds an angle of at most a quarter to either side.
  void add(double cosine, double sine) {
    const double re = mRe * cosine - mIm * sine, im = mRe * sine + mIm * cosine;
    // Two angles of one sign passed a quarter on that side, whatever rounding made of their sum.
    const bool left = (mIm > 0) == (sine > 0) ? sine > 0 : im > 0;
    if (re < 0) addHalf(left ? 1 : -1);
    const double sign = re < 0 ? -1 : 1;
    mRe = sign * re;
    mIm = sign * im;
  }
  void addHalf(int sign) { mHalves += sign; }
  /// Keeps the product from growing without end.
  void rescale() {
    const double scale = 1 / std::max(mRe, std::abs(mIm));
    mRe *= scale;
    mIm *= scale;
  }
  [[nodiscard]] double sum() const { return 0.5 * mHalves + std::atan2(mIm, mRe) / (2 * std::numbers::pi); }

 private:
  double mRe = 1, mIm = 0;
  int mHalves = 0;
};

template <typename Far, typename Near>
void SolidAngles::visit(const Vec3d& p, const Far& far, const Near& near) const {
  if (mNodes.empty()) return;
  std::array<std::uint32_t, 64> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = mNodes[stack[--size]];
    const Vec3d r = node.middle - p;
    if (dot(r, r) > kFar * kFar * node.radius * node.radius) {
      far(node);
    } else if (node.child == 0) {
      near(node);
    } else {
      stack[size++] = node.child + 1;
      stack[size++] = node.child;
    }
  }
}

double SolidAngles::at(const Vec3d& p) const {
  double sum = 0;
  Turns turns;
  visit(
      p, [&](const Node& node) { sum += farAngle(node, p); }, [&](const Node& node) { addTurns(node, p, turns); });
  return sum + turns.sum();
}

double SolidAngles::farAngle(const Node& node, const Vec3d& p) {
  // A triangle at r adds dot(normal, r) / |r|³, and this is differentiated by its place.
  const Vec3d r = node.middle - p;
  const double inverse = 1 / dot(r, r), cubed = inverse * std::sqrt(inverse);
  const Mat3d& m = node.moment;
  const double trace = m.row[0].x + m.row[1].y + m.row[2].z;
  return (dot(node.normal, r) + trace - 3 * dot(r, m * r) * inverse) * cubed / kSphere;
}

void SolidAngles::addTurns(const Node& node, const Vec3d& p, Turns& turns) const {
  const Leaf& leaf = mLeaves[node.leaf];
  Lanes cosine, sine;
  // van Oosterom & Strackee 1983: half a solid angle as the argument of a complex number.
  withSimd(bestSimdLevel(), [&] {
    forEachLane<kLeaf>([&](int lane) {
      const auto corner = [&](std::size_t i) {
        const auto& c = leaf.corner[i];
        const auto l = static_cast<std::size_t>(lane);
        return Vec3d{c[0][l] - p.x, c[1][l] - p.y, c[2][l] - p.z};
      };
      const Vec3d a = corner(0), b = corner(1), c = corner(2);
      const double la = length(a), lb = length(b), lc = length(c), scale = 1 / (la * lb * lc);
      cosine[lane] = scale * (la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
      sine[lane] = scale * dot(a, cross(b, c));
    });
  });
  for (std::uint32_t i = 0; i < node.count; ++i) {
    const int lane = static_cast<int>(i);
    double c = cosine[lane], s = sine[lane];
    if (!(c * c + s * s > 0)) continue;  // p is on an edge or a corner.
    if (c < 0) {
      int side = s > 0 ? 1 : -1;
      if (std::abs(s) < kUnsure) side = -sideOfPlane(p, mSurface.points(mTriangles[node.first + i]));
      if (side == 0) continue;
      turns.addHalf(side);
      c = -c, s = -s;
    }
    turns.add(c, s);
  }
  turns.rescale();
}

Vec3d SolidAngles::gradient(const Vec3d& p) const {
  Vec3d sum{};
  visit(
      p,
      [&](const Node& node) {
        // The derivative of farAngle().
        const Vec3d r = node.middle - p;
        const double inverse = 1 / dot(r, r), cubed = inverse * std::sqrt(inverse);
        const Mat3d& m = node.moment;
        const Vec3d mr = m * r, both = mr + m.transposed() * r;
        const double trace = m.row[0].x + m.row[1].y + m.row[2].z;
        const double along = dot(node.normal, r) + trace - 5 * dot(r, mr) * inverse;
        sum -= (node.normal - (both + r * along) * (3 * inverse)) * cubed;
      },
      [&](const Node& node) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          sum += gradientOf(p, mSurface.points(mTriangles[i]));
      });
  return sum * (1 / kSphere);
}

double SolidAngles::bound(const Box& box, double limit) const {
  double sum = 0;
  if (!mNodes.empty()) addBound(0, box, limit, sum);
  return sum;
}

void SolidAngles::addBound(std::uint32_t number, const Box& box, double limit, double& sum) const {
  if (sum >= limit) return;
  const Node& node = mNodes[number];
  const double d = std::sqrt(box.squaredDistance(node.middle)) - node.radius;
  if (d > 2 * node.radius || (node.child == 0 && d > 0)) {
    sum += std::min(node.area / (kSphere * d * d), 0.5 * node.count);
  } else if (node.child == 0) {
    sum += 0.5 * node.count;
  } else {
    addBound(node.child, box, limit, sum);
    addBound(node.child + 1, box, limit, sum);
  }
}

}  // namespace pdc::detail
