#include "smooth/vertex_sigmas.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 1024;

/// No more triangles of a vertex are looked at, or each of its neighbours would look at all of them.
constexpr std::size_t kMostCorners = 32;

/// The median difference of angle defects from their median, in radians, for noise of one mean edge if it grew with its
/// square all the way, and that of the heights over neighbours per noise: from noise of a tenth of an edge on planes,
/// a little less than there because of the minimum of both.
constexpr double kDefectPerSquare = 3, kHeightPerNoise = 0.68;

/// Less noise than this, in mean edges, is what sampling does to clean surfaces: of clean contours and CAD meshes one
/// vertex in a hundred seems to have up to 0.03.
constexpr double kLeastSigma = 0.03;

/// The median, 0 for none; the upper one of two.
double medianOf(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <typename Visit>
void forEachVertex(std::size_t vertices, BlockProgress& progress, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices, kGrain), [&](const auto& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) visit(static_cast<std::uint32_t>(v));
    progress.advance(range.size());
  });
}

std::span<const Corner> someCorners(const SmoothedSurface& surface, std::uint32_t vertex) {
  const std::span<const Corner> all = surface.corners(vertex);
  return all.first(std::min(all.size(), kMostCorners));
}

/// How a surface bends at a vertex.
struct Bend {
  double defect;  ///< What the angles of its triangles lack to a full turn.
  double height;  ///< How far it lies beyond the mean of its neighbours, along the normal.
};

Bend bendAt(const SmoothedSurface& surface, std::uint32_t vertex) {
  const Buffer<Vec3d>& p = surface.positions();
  Vec3d sum{}, normal{};
  double angles = 0;
  for (const Corner& c : surface.corners(vertex)) {
    const Vec3d a = p[c.next] - p[vertex], b = p[c.previous] - p[vertex], n = cross(a, b);
    sum += a;
    normal += n;
    angles += std::atan2(length(n), dot(a, b));
  }
  const double l = length(normal), count = static_cast<double>(surface.corners(vertex).size());
  return {2 * std::numbers::pi - angles, l > 0 ? -dot(normal, sum) / (l * count) : 0};
}

/// Looks at one vertex after the other, to keep its memory.
class Neighbourhood {
 public:
  /// The vertices up to `rings` edges away, each once, with the vertex itself.
  const std::vector<std::uint32_t>& look(const SmoothedSurface& surface, std::uint32_t vertex, int rings) {
    mVertices.assign(1, vertex);
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t end = mVertices.size();
      for (; begin < end; ++begin)
        for (const Corner& c : someCorners(surface, mVertices[begin])) {
          mVertices.push_back(c.next);
          // Within the surface each is next to another triangle.
          if (surface.atBoundary(mVertices[begin])) mVertices.push_back(c.previous);
        }
    }
    std::sort(mVertices.begin(), mVertices.end());
    mVertices.erase(std::unique(mVertices.begin(), mVertices.end()), mVertices.end());
    return mVertices;
  }

  /// The median of how much the values that pick(vertex) gives differ from their median. At the boundary, where angles
  /// make no full turn, vertices are left out.
  template <typename Pick>
  double spread(const SmoothedSurface& surface, const Pick& pick) {
    mValues.clear();
    for (const std::uint32_t v : mVertices)
      if (!surface.atBoundary(v)) mValues.push_back(pick(v));
    const double middle = medianOf(mValues);
    for (double& value : mValues) value = std::abs(value - middle);
    return medianOf(mValues);
  }

  template <typename Pick>
  double median(const Pick& pick) {
    mValues.clear();
    for (const std::uint32_t v : mVertices) mValues.push_back(pick(v));
    return medianOf(mValues);
  }

 private:
  std::vector<std::uint32_t> mVertices;
  std::vector<double> mValues;
};

}  // namespace

std::vector<double> measuredSigmas(const SmoothedSurface& surface, BlockProgress& progress) {
  const std::size_t vertices = surface.vertices();
  std::vector<Bend> bends(vertices);
  forEachVertex(vertices, progress, [&](std::uint32_t v) { bends[v] = bendAt(surface, v); });
  tbb::enumerable_thread_specific<Neighbourhood> neighbourhoods;
  std::vector<double> raw(vertices), sigmas(vertices);
  forEachVertex(vertices, progress, [&](std::uint32_t v) {
    Neighbourhood& around = neighbourhoods.local();
    around.look(surface, v, 2);
    const double defect = around.spread(surface, [&](std::uint32_t u) { return bends[u].defect; });
    const double height = around.spread(surface, [&](std::uint32_t u) { return bends[u].height; });
    raw[v] = std::min(std::sqrt(defect / kDefectPerSquare), height / kHeightPerNoise);
  });
  // Once more the median, because where creases meet a few vertices may seem to have noise.
  forEachVertex(vertices, progress, [&](std::uint32_t v) {
    Neighbourhood& around = neighbourhoods.local();
    around.look(surface, v, 1);
    const double sigma = around.median([&](std::uint32_t u) { return raw[u]; });
    sigmas[v] = beyondDoubt(sigma, kLeastSigma);
  });
  return sigmas;
}

}  // namespace pdc::detail
