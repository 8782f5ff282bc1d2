#include "pdc/simplify/cluster.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "pdc/math/triangle_quadric.h"
#include "pdc/mesh/weld_vertices.h"
#include "simplify/clustering/cell_grid.h"
#include "simplify/clustering/cell_sums.h"
#include "simplify/clustering/clean_faces.h"
#include "simplify/clustering/key_numbers.h"
#include "simplify/clustering/representative.h"

namespace pdc {
namespace {

void check(const ClusterOptions& o) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(fmt::format("cluster: {}", what));
  };
  require(o.cell > 0 && std::isnormal(o.cell) && std::isnormal(1 / o.cell), "the edge of the cells is not above 0");
  require(o.sigmaNormal >= 0 && std::isfinite(o.sigmaNormal), "sigma_n is not 0 or more");
  require(o.sigmaPosition >= 0 && std::isfinite(o.sigmaPosition), "sigma_p is not 0 or more");
  require(!o.weld || (*o.weld >= 0 && std::isfinite(*o.weld)), "the distance to weld within is not 0 or more");
}

/// What a triangle adds to the cells of its corners, seen from its first corner; u and v are the edges from there on.
/// Where `ofCorner` is set each corner adds the quadric as seen from itself instead.
struct TriangleError {
  NormalEquations<double> error;
  bool ofCorner;
};

template <QuadricKind kind>
TriangleError triangleError(const Vec3d& u, const Vec3d& v, double squaredSigmaNormal, double sigmaPosition) {
  if constexpr (kind == QuadricKind::kProbabilisticTriangle) {
    return {probabilisticTriangleQuadric(Vec3d{}, u, v, sigmaPosition).normalEquations(), false};
  } else {
    const Vec3d n = cross(u, v);
    const double size = length(n);
    // All planes go through the corner, so only A says something there.
    SymMat3<double> A = SymMat3<double>::identity() * size;
    if constexpr (kind == QuadricKind::kTriangle) A = outer(n);
    if constexpr (kind == QuadricKind::kPlane || kind == QuadricKind::kProbabilisticPlane)
      A = outer(n) * (size > 0 ? 1 / size : 0);
    if constexpr (kind == QuadricKind::kProbabilisticPlane) A = A.plusDiagonal(squaredSigmaNormal * size);
    return {{A, Vec3d{}}, true};
  }
}

bool isFinite(const std::array<Vec3f, 3>& t) {
  return detail::isFinite(t[0]) && detail::isFinite(t[1]) && detail::isFinite(t[2]);
}

}  // namespace

struct Clustering::State {
  explicit State(const ClusterOptions& o) : options(o), grid(o.cell) {}

  /// The number of a cell, which is made if there is none.
  std::uint32_t numberOf(std::uint64_t key) {
    // Neighbours in the stream mostly are neighbours in space.
    if (key == lastKey) return lastNumber;
    const std::uint32_t before = numbers.size();
    lastNumber = numbers.numberOf(key);
    lastKey = key;
    if (numbers.size() != before) cells.push_back({key, NormalEquations<double>::zero(), Vec3d{}, 0});
    return lastNumber;
  }

  template <QuadricKind kind>
  void add(std::span<const std::array<Vec3f, 3>> triangles) {
    const double squaredSigmaNormal = options.sigmaNormal * options.sigmaNormal;
    for (const std::array<Vec3f, 3>& t : triangles) {
      if (!isFinite(t)) {
        ++nonFinite;
        continue;
      }
      // Differences of places in cells would lose digits far from the origin.
      const Vec3d p = vecCast<double>(t[0]), u = (vecCast<double>(t[1]) - p) * grid.inverse(),
                  v = (vecCast<double>(t[2]) - p) * grid.inverse();
      const TriangleError e = triangleError<kind>(u, v, squaredSigmaNormal, options.sigmaPosition);
      const std::array<Vec3d, 3> fromFirst{Vec3d{}, u, v};
      Triangle face{};
      for (std::size_t k = 0; k < 3; ++k) {
        const detail::CellPlace place = grid.place(t[k]);
        face[k] = numberOf(place.key);
        detail::CellSums& sums = cells[face[k]];
        const Vec3d origin = e.ofCorner ? place.local : place.local - fromFirst[k];
        sums.error += {e.error.A, e.error.b + e.error.A * origin};
        sums.corners += place.local;
        sums.count += 1;
      }
      if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) faces.push_back(face);
    }
    given += triangles.size();
  }

  ClusterOptions options;
  detail::CellGrid grid;
  detail::KeyNumbers numbers;
  detail::CellSumsList cells;
  Buffer<Triangle> faces;
  std::uint64_t lastKey = detail::KeyNumbers::kNoKey;
  std::uint32_t lastNumber = 0;
  std::size_t given = 0, nonFinite = 0;
};

Clustering::Clustering(const ClusterOptions& options) {
  check(options);
  if (options.weld) throw std::invalid_argument("cluster: there are no vertices to weld in a stream of triangles");
  mState = std::make_unique<State>(options);
}

Clustering::~Clustering() = default;

void Clustering::add(std::span<const std::array<Vec3f, 3>> triangles) {
  switch (mState->options.quadric) {
    case QuadricKind::kPlane:
      return mState->add<QuadricKind::kPlane>(triangles);
    case QuadricKind::kTriangle:
      return mState->add<QuadricKind::kTriangle>(triangles);
    case QuadricKind::kProbabilisticPlane:
      return mState->add<QuadricKind::kProbabilisticPlane>(triangles);
    case QuadricKind::kProbabilisticTriangle:
      return mState->add<QuadricKind::kProbabilisticTriangle>(triangles);
    case QuadricKind::kPoint:
      return mState->add<QuadricKind::kPoint>(triangles);
  }
}

Mesh Clustering::finish(ClusterReport* report) {
  State& state = *mState;
  ClusterReport facts;
  facts.trianglesBefore = state.given;
  facts.nonFiniteTriangles = state.nonFinite;
  facts.collapsedTriangles = state.given - state.nonFinite - state.faces.size();
  facts.cells = state.numbers.size();
  Mesh mesh;
  mesh.triangles = std::move(state.faces);
  if (state.options.clean) {
    const detail::DroppedFaces dropped = detail::cleanFaces(mesh.triangles);
    facts.foldedFaces = dropped.folded;
    facts.duplicateFaces = dropped.duplicate;
  }

  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> vertexOf(facts.cells, kUnused), cellOf;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t cell : t) vertexOf[cell] = 0;
  for (std::uint32_t cell = 0; cell < facts.cells; ++cell) {
    if (vertexOf[cell] == kUnused) continue;
    vertexOf[cell] = static_cast<std::uint32_t>(cellOf.size());
    cellOf.push_back(cell);
  }
  for (Triangle& t : mesh.triangles) t = {vertexOf[t[0]], vertexOf[t[1]], vertexOf[t[2]]};

  const detail::RepresentativeRule rule(state.options);
  std::atomic<std::size_t> outside = 0;
  mesh.positions.resize(cellOf.size());
  tbb::parallel_for(std::size_t{0}, cellOf.size(), [&](std::size_t v) {
    const detail::CellSums& sums = std::as_const(state.cells)[cellOf[v]];
    const detail::Representative r = detail::representative(sums, rule);
    if (r.outside) outside.fetch_add(1, std::memory_order_relaxed);
    mesh.positions[v] = state.grid.position(sums.key, r.place);
  });
  facts.outsideVertices = outside;
  facts.trianglesAfter = mesh.triangles.size();
  facts.vertices = mesh.positions.size();
  if (report != nullptr) *report = facts;
  return mesh;
}

namespace {

Mesh clusterWelded(const Mesh& mesh, ClusterOptions options, ClusterReport* report, const Monitor& monitor) {
  detail::checkSizes(mesh, "cluster");
  Mesh welded = mesh;
  const WeldReport weld = weldVertices(welded, *options.weld, monitor);
  options.weld.reset();
  ClusterReport facts;
  Mesh result = cluster(welded, options, &facts, monitor);
  facts.collapsedTriangles += detail::triangleCount(mesh) - detail::triangleCount(welded);
  facts.trianglesBefore = detail::triangleCount(mesh);
  facts.weldedVertices = weld.weldedVertices;
  if (report != nullptr) *report = facts;
  return result;
}

}  // namespace

Mesh cluster(const Mesh& mesh, const ClusterOptions& options, ClusterReport* report, const Monitor& monitor) {
  check(options);
  if (options.weld) return clusterWelded(mesh, options, report, monitor);
  Clustering clustering(options);
  detail::checkSizes(mesh, "cluster");
  detail::checkIndices(mesh);
  constexpr std::size_t kBlock = std::size_t{1} << 14;
  const std::size_t count = detail::triangleCount(mesh);
  std::vector<std::array<Vec3f, 3>> block;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    monitor.throwIfStopped();
    if (monitor.progress) monitor.progress("cluster", static_cast<double>(begin) / static_cast<double>(count));
    block.clear();
    for (std::size_t i = begin; i < std::min(begin + kBlock, count); ++i)
      block.push_back(detail::corners(mesh, detail::triangle(mesh, i)));
    clustering.add(block);
  }
  monitor.throwIfStopped();
  Mesh result = clustering.finish(report);
  result.origin = mesh.origin;
  return result;
}

}  // namespace pdc
