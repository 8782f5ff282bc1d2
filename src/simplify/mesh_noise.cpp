#include "simplify/mesh_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "pdc/simplify/decimate.h"

namespace pdc {
namespace detail {
namespace {

/// So many vertices, evenly spread over their numbers, tell the noise well enough.
constexpr std::size_t kSample = 4096;

/// Vertices with more faces say nothing: each edge there would be compared with all the others.
constexpr std::size_t kMostFaces = 32;

/// Noise per bend that differs, in radians: found with noise of a tenth of an edge on spheres.
constexpr double kNoisePerJump = 1.25;

/// The edges at one vertex, with the angles by which the surface bends there: positive where it is convex, NaN where it
/// ends.
class BendsAt {
 public:
  BendsAt(const VertexStars& stars, const std::vector<Vec3d>& positions) : mStars(stars), mPositions(positions) {}

  void look(std::uint32_t vertex) {
    const std::span<const StarCorner> star = mStars[vertex];
    const Vec3d& p = mPositions[vertex];
    mBends.clear();
    if (star.size() > kMostFaces) return;
    for (const StarCorner& c : star) {
      const StarCorner* const other = cornerAfter(star, c.next);
      const double angle =
          other == nullptr ? std::nan("") : angleAt(normalOf(p, *other), normalOf(p, c), mPositions[c.next] - p);
      mBends.push_back({c.next, angle});
    }
  }

  struct Bend {
    std::uint32_t to;
    double angle;
  };
  [[nodiscard]] const std::vector<Bend>& operator()() const { return mBends; }

 private:
  [[nodiscard]] Vec3d normalOf(const Vec3d& p, const StarCorner& c) const {
    return cross(mPositions[c.next] - p, mPositions[c.previous] - p);
  }
  /// \param n0, n1 normals of any length of the faces on the right and on the left of an edge.
  static double angleAt(const Vec3d& n0, const Vec3d& n1, const Vec3d& edge) {
    const Vec3d turn = cross(n0, n1);
    const double size = std::atan2(length(turn), dot(n0, n1));
    return dot(turn, edge) < 0 ? -size : size;
  }

  const VertexStars& mStars;
  const std::vector<Vec3d>& mPositions;
  std::vector<Bend> mBends;
};

/// The second smallest of some numbers.
struct SecondSmallest {
  double first = std::numeric_limits<double>::infinity(), second = first;

  void add(double value) {
    if (value < first) {
      second = first;
      first = value;
    } else if (value < second) {
      second = value;
    }
  }
};

/// By how much the bends at a vertex's edges differ from the second nearest of those at the edges they meet. A crease
/// goes on at both of its ends, and an even surface bends everywhere as much.
void addJumps(std::uint32_t vertex, BendsAt& own, BendsAt& others, std::vector<double>& jumps) {
  own.look(vertex);
  for (const BendsAt::Bend& bend : own()) {
    SecondSmallest nearest;
    for (const BendsAt::Bend& other : own())
      if (other.to != bend.to) nearest.add(std::abs(other.angle - bend.angle));
    others.look(bend.to);
    for (const BendsAt::Bend& other : others())
      if (other.to != vertex) nearest.add(std::abs(other.angle - bend.angle));
    if (std::isfinite(nearest.second)) jumps.push_back(nearest.second);
  }
}

}  // namespace

double meshNoise(const VertexStars& stars, const std::vector<Vec3d>& positions) {
  BendsAt own(stars, positions), others(stars, positions);
  std::vector<double> jumps;
  const std::size_t step = std::max<std::size_t>(1, stars.vertices() / kSample);
  for (std::size_t v = 0; v < stars.vertices(); v += step) addJumps(static_cast<std::uint32_t>(v), own, others, jumps);
  if (jumps.empty()) return 0;
  const auto middle = jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2);
  std::nth_element(jumps.begin(), middle, jumps.end());
  return kNoisePerJump * *middle;
}

}  // namespace detail

double meshNoise(const Mesh& mesh) {
  detail::checkSizes(mesh, "meshNoise");
  detail::checkIndices(mesh);
  std::vector<Triangle> faces(detail::triangleCount(mesh));
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = detail::triangle(mesh, i);
  std::vector<Vec3d> positions;
  for (const Vec3f& p : mesh.positions) positions.push_back(vecCast<double>(p));
  detail::VertexStars stars;
  stars.build(faces, positions.size());
  return detail::meshNoise(stars, positions);
}

}  // namespace pdc
