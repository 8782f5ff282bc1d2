#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "pdc/simplify/decimate.h"
#include "simplify/vertex_stars.h"

namespace pdc {
namespace {

/// The signed angles by which a surface bends at its edges, positive where it is convex.
class Bends {
 public:
  Bends(const Mesh& mesh, const std::vector<Triangle>& faces) : mNormals(faces.size()) {
    mStars.build(faces, mesh.positions.size());
    mAngles.assign(mStars.cornerCount(), std::nan(""));
    const auto at = [&](std::uint32_t v) { return vecCast<double>(mesh.positions[v]); };
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t f) {
      const Triangle& t = faces[f];
      mNormals[f] = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    });
    tbb::parallel_for(std::size_t{0}, mStars.vertices(), [&](std::size_t i) {
      const auto v = static_cast<std::uint32_t>(i);
      for (std::size_t k = 0; k < mStars[v].size(); ++k) {
        const detail::StarCorner& c = mStars[v][k];
        const detail::StarCorner* const other = detail::cornerAfter(mStars[v], c.next);
        if (other != nullptr)
          mAngles[mStars.first(v) + k] = angle(mNormals[other->face], mNormals[c.face], at(c.next) - at(v));
      }
    });
  }

  /// By how much the bend at each edge differs from the second nearest of those at the edges it meets. A crease goes on
  /// at both of its ends, and an even surface bends everywhere as much.
  [[nodiscard]] std::vector<double> jumps() const {
    std::vector<double> jump(mAngles.size(), std::nan(""));
    tbb::parallel_for(std::size_t{0}, mStars.vertices(), [&](std::size_t i) {
      const auto v = static_cast<std::uint32_t>(i);
      for (std::size_t k = 0; k < mStars[v].size(); ++k) {
        const std::uint32_t next = mStars[v][k].next;
        if (next < v) continue;  // It is the other end's.
        std::array<double, 2> nearest{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        const double own = mAngles[mStars.first(v) + k];
        addDifferences(own, v, next, nearest);
        addDifferences(own, next, v, nearest);
        jump[mStars.first(v) + k] = nearest[1];
      }
    });
    std::erase_if(jump, [](double j) { return !std::isfinite(j); });
    return jump;
  }

 private:
  /// \param n0, n1 normals of any length of the faces on the right and on the left of an edge.
  static double angle(const Vec3d& n0, const Vec3d& n1, const Vec3d& edge) {
    const Vec3d turn = cross(n0, n1);
    const double size = std::atan2(length(turn), dot(n0, n1));
    return dot(turn, edge) < 0 ? -size : size;
  }

  void addDifferences(double own, std::uint32_t vertex, std::uint32_t except, std::array<double, 2>& nearest) const {
    for (std::size_t k = 0; k < mStars[vertex].size(); ++k) {
      if (mStars[vertex][k].next == except) continue;
      const double difference = std::abs(mAngles[mStars.first(vertex) + k] - own);
      if (difference < nearest[0]) {
        nearest = {difference, nearest[0]};
      } else if (difference < nearest[1]) {
        nearest[1] = difference;
      }
    }
  }

  detail::VertexStars mStars;
  std::vector<Vec3d> mNormals;
  std::vector<double> mAngles;  ///< By corner, at the edge that leaves there.
};

}  // namespace

double meshNoise(const Mesh& mesh) {
  detail::checkSizes(mesh, "meshNoise");
  detail::checkIndices(mesh);
  std::vector<Triangle> faces(detail::triangleCount(mesh));
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = detail::triangle(mesh, i);
  std::vector<double> jumps = Bends(mesh, faces).jumps();
  if (jumps.empty()) return 0;
  const auto middle = jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2);
  std::nth_element(jumps.begin(), middle, jumps.end());
  // Found with noise of a tenth of an edge on spheres.
  constexpr double kNoisePerJump = 1.25;
  return kNoisePerJump * *middle;
}

}  // namespace pdc
