#include "pdc/mesh/mesh_comparison.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "mesh/nearest_triangles.h"
#include "parallel/block_progress.h"
#include "pdc/error.h"

namespace pdc {
namespace {

constexpr std::size_t kChunk = 512;  ///< Points that are looked up in a row, each beginning where the last one ended.

/// The finaliser of splitmix64.
std::uint64_t hash(std::uint64_t h) {
  h += 0x9E3779B97F4A7C15;
  h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9;
  h = (h ^ h >> 27) * 0x94D049BB133111EB;
  return h ^ h >> 31;
}

double unitFraction(std::uint32_t bits) { return (bits + 0.5) * 0x1p-32; }

/// A mesh as something to take points from and to find points on.
class Surface {
 public:
  /// \param name of the mesh in errors.
  Surface(const Mesh& mesh, const char* name) : mMesh(mesh), mTriangles(mesh), mAreas(detail::triangleCount(mesh)) {
    tbb::parallel_for(std::size_t{0}, mAreas.size(), [&](std::size_t i) {
      const double area = length(detail::areaNormal(corners(i)));
      mAreas[i] = std::isfinite(area) ? area : 0;
    });
    double sum = 0;
    for (double& area : mAreas) area = sum += area;
    if (!(sum > 0)) throw Error(fmt::format("no comparison: the {} has no face with finite corners and an area", name));
  }

  [[nodiscard]] const Mesh& mesh() const { return mMesh; }
  [[nodiscard]] const detail::NearestTriangles& triangles() const { return mTriangles; }
  [[nodiscard]] detail::TriangleCorners corners(std::size_t triangle) const {
    return detail::corners(mMesh, detail::triangle(mMesh, triangle));
  }

  /// The triangle that holds a share of the area, in (0, 1), together with all triangles before it. It has an area.
  [[nodiscard]] std::size_t triangleAt(double share) const {
    const auto it = std::upper_bound(mAreas.begin(), mAreas.end(), share * mAreas.back());
    // The product may be rounded up to the sum.
    if (it == mAreas.end()) return triangleAt(std::nextafter(share, 0.0));
    return static_cast<std::size_t>(it - mAreas.begin());
  }

 private:
  const Mesh& mMesh;
  detail::NearestTriangles mTriangles;
  Buffer<double> mAreas;  ///< Of each triangle and those before it, doubled.
};

struct Sample {
  Vec3d position, normal;  ///< The normal has length 1.
};

Sample sampleOf(const Surface& surface, std::size_t i, std::size_t count) {
  const auto triangle = surface.triangleAt((static_cast<double>(i) + 0.5) / static_cast<double>(count));
  const detail::TriangleCorners corners = surface.corners(triangle);
  const std::uint64_t h = hash(i);
  double u = unitFraction(static_cast<std::uint32_t>(h >> 32)), v = unitFraction(static_cast<std::uint32_t>(h));
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const Vec3d a = vecCast<double>(corners[0]), normal = detail::areaNormal(corners);
  return {a + (vecCast<double>(corners[1]) - a) * u + (vecCast<double>(corners[2]) - a) * v,
          normal * (1 / length(normal))};
}

/// The vertices of all faces whose corners are finite.
Buffer<std::uint32_t> usedVertices(const Mesh& mesh) {
  std::vector<bool> used(mesh.positions.size());
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const Triangle t = detail::triangle(mesh, i);
    const detail::TriangleCorners c = detail::corners(mesh, t);
    if (!std::all_of(c.begin(), c.end(), detail::isFinite)) continue;
    for (const std::uint32_t v : t) used[v] = true;
  }
  Buffer<std::uint32_t> vertices;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) vertices.push_back(static_cast<std::uint32_t>(v));
  return vertices;
}

struct AngleSums {
  double sum = 0, squares = 0;
  std::size_t count = 0, opposed = 0;

  void add(double degrees) {
    sum += degrees;
    squares += degrees * degrees;
    ++count;
    opposed += degrees > 90;
  }
  void add(const AngleSums& o) {
    sum += o.sum;
    squares += o.squares;
    count += o.count;
    opposed += o.opposed;
  }
};

double degreesBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

/// Calls visit(first, end) for ranges that depend on the count only.
template <typename Visit>
void forEachChunk(std::size_t count, detail::BlockProgress& progress, Visit&& visit) {
  tbb::parallel_for(std::size_t{0}, (count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk, end = std::min(count, first + kChunk);
    visit(first, end);
    progress.advance(end - first);
  });
}

/// From one surface to another.
class Measurement {
 public:
  Measurement(const Surface& from, const Surface& to)
      : mFrom(from), mTo(to), mOffset(from.mesh().origin - to.mesh().origin), mVertices(usedVertices(from.mesh())) {}

  /// How many points are looked up.
  [[nodiscard]] std::size_t work(std::size_t samples) const { return samples + mVertices.size(); }

  /// \param angles is added to.
  [[nodiscard]] DistanceFigures run(std::size_t samples, AngleSums& angles, detail::BlockProgress& progress) const {
    DistanceFigures figures{.largest = largestOfVertices(progress), .samples = samples};
    Buffer<double> distances = measureSamples(samples, angles, progress);
    double sum = 0, squares = 0;
    for (const double d : distances) {
      sum += d;
      squares += d * d;
      figures.largest = std::max(figures.largest, d);
    }
    const auto count = static_cast<double>(samples);
    figures.mean = sum / count;
    figures.rms = std::sqrt(squares / count);
    const auto rank = distances.begin() + static_cast<std::ptrdiff_t>(std::ceil(0.999 * count)) - 1;
    std::nth_element(distances.begin(), rank, distances.end());
    figures.p999 = *rank;
    return figures;
  }

 private:
  [[nodiscard]] Buffer<double> measureSamples(std::size_t samples, AngleSums& angles,
                                              detail::BlockProgress& progress) const {
    Buffer<double> distances(samples);
    std::vector<AngleSums> parts((samples + kChunk - 1) / kChunk);
    forEachChunk(samples, progress, [&](std::size_t first, std::size_t end) {
      detail::NearestTriangle nearest;
      for (std::size_t i = first; i < end; ++i) {
        const auto [position, normal] = sampleOf(mFrom, i, samples);
        nearest = mTo.triangles().find(position + mOffset, normal, nearest.number);
        distances[i] = std::sqrt(nearest.squared);
        const Vec3d found = detail::areaNormal(mTo.corners(nearest.number));
        if (dot(found, found) > 0) parts[first / kChunk].add(degreesBetween(normal, found));
      }
    });
    // The order of floating-point sums must not depend on the threads.
    for (const AngleSums& part : parts) angles.add(part);
    return distances;
  }

  [[nodiscard]] double largestOfVertices(detail::BlockProgress& progress) const {
    std::vector<double> parts((mVertices.size() + kChunk - 1) / kChunk);
    forEachChunk(mVertices.size(), progress, [&](std::size_t first, std::size_t end) {
      detail::NearestTriangle nearest;
      for (std::size_t i = first; i < end; ++i) {
        const Vec3d p = vecCast<double>(mFrom.mesh().positions[mVertices[i]]);
        nearest = mTo.triangles().find(p + mOffset, nearest.number);
        parts[first / kChunk] = std::max(parts[first / kChunk], nearest.squared);
      }
    });
    return std::sqrt(*std::max_element(parts.begin(), parts.end()));
  }

  const Surface &mFrom, &mTo;
  Vec3d mOffset;  ///< What makes a position of one relative to the origin of the other.
  Buffer<std::uint32_t> mVertices;
};

void check(const Mesh& mesh) {
  detail::checkSizes(mesh, "compareMeshes");
  detail::checkIndices(mesh);
}

}  // namespace

MeshComparison compareMeshes(const Mesh& mesh, const Mesh& reference, const ComparisonOptions& options,
                             const Monitor& monitor) {
  if (options.samples == 0) throw std::invalid_argument("compareMeshes: samples must be 1 at least");
  check(mesh);
  check(reference);
  monitor.throwIfStopped();
  const Surface surface(mesh, "mesh"), other(reference, "reference");
  const Measurement there(surface, other), back(other, surface);
  detail::BlockProgress progress(monitor, "comparing", there.work(options.samples) + back.work(options.samples));
  MeshComparison comparison;
  AngleSums angles;
  comparison.toReference = there.run(options.samples, angles, progress);
  if (angles.count > 0)
    comparison.opposedShare = static_cast<double>(angles.opposed) / static_cast<double>(angles.count);
  comparison.fromReference = back.run(options.samples, angles, progress);
  if (angles.count > 0) {
    comparison.meanAngle = angles.sum / static_cast<double>(angles.count);
    comparison.rmsAngle = std::sqrt(angles.squares / static_cast<double>(angles.count));
  }
  return comparison;
}

}  // namespace pdc
