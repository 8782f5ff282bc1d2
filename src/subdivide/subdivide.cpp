#include "pdc/subdivide/subdivide.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "parallel/block_progress.h"
#include "parallel/for_each_in_parallel.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"
#include "pdc/mesh/triangulate_polygons.h"
#include "pdc/mesh/vertex_covariances.h"
#include "subdivide/half_edges.h"
#include "subdivide/limit_surface.h"
#include "subdivide/refine_vertices.h"
#include "subdivide/vertex_sums.h"

namespace pdc {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kMostLevels = 31;
constexpr double kMegabyte = 1e6;

void checkOptions(const SubdivideOptions& options) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("subdivide: " + what); };
  if (options.levels < 1 || options.levels > kMostLevels)
    refuse(fmt::format("{} levels, must be 1 to {}", options.levels, kMostLevels));
  const double angle = options.creaseAngle.value_or(180);
  if (!(angle > 0 && angle <= 180)) refuse(fmt::format("a crease angle of {}, must be above 0 and at most 180", angle));
  if ((options.normals || options.curvature) && !options.limit) refuse("normals and curvature need the limit");
}

/// The mesh that is subdivided: all of its vertices have faces, and for Loop's scheme those are triangles.
Mesh takeInput(const Mesh& given, SubdivisionScheme scheme, SubdivideReport& report) {
  detail::checkIndices(given);
  Mesh mesh = given;
  if (scheme == SubdivisionScheme::kLoop) {
    report.triangulatedFaces = mesh.quads.size() + mesh.polygons.size();
    Buffer<Triangle> triangles(detail::triangleCount(mesh));
    for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i] = detail::triangle(mesh, i);
    mesh.triangles = std::move(triangles);
    mesh.quads = {};
    triangulatePolygons(mesh);
  }
  return mesh;
}

/// Drops vertices without faces, with what belongs to them.
void dropUnused(Mesh& mesh, Buffer<SymMat3<double>>& covariances, SubdivideReport& report) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.positions.size(), kUnused);
  for (std::size_t f = 0; f < detail::faceCount(mesh); ++f)
    for (const std::uint32_t v : detail::face(mesh, f)) number[v] = 0;
  std::uint32_t used = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = used;
    mesh.positions[used] = mesh.positions[v];
    if (!covariances.empty()) covariances[used] = covariances[v];
    ++used;
  }
  report.unusedVertices = number.size() - used;
  mesh.positions.resize(used);
  if (!covariances.empty()) covariances.resize(used);
  if (report.unusedVertices == 0) return;
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = number[v];
  for (Quad& q : mesh.quads)
    for (std::uint32_t& v : q) v = number[v];
  for (std::uint32_t& v : mesh.polygons.corners) v = number[v];
}

/// What the last level takes for each vertex of the result: Gaussians or places, half-edges of the level before, faces
/// and positions; and with limits those again, and the half-edges.
double bytesPerVertex(const SubdivideOptions& options) {
  const bool gaussians = options.covariances.has_value();
  return (gaussians ? 150 : 90) + (options.limit ? (gaussians ? 180 : 130) : 0) + (options.keepCovariances ? 100 : 0) +
         (options.keepPlaces ? 24 : 0);
}

void checkSize(const detail::HalfEdges& topology, const SubdivideOptions& options) {
  constexpr double kMost = 4294967296.0;  // 2^32
  const detail::RefinedCounts counts =
      detail::countRefined(topology, options.scheme == SubdivisionScheme::kLoop, options.levels);
  const auto check = [&](double count, const char* what) {
    if (count >= kMost)
      throw Error(fmt::format("{} levels make {:.4g} {}; the limit is 2^32 - 1", options.levels, count, what));
  };
  check(counts.faces, "faces");
  check(counts.vertices, "vertices");
  if (options.limit) check(counts.halfEdges, "corners of faces, which limits are made from");
  const double needed = counts.vertices * bytesPerVertex(options);
  const auto left = static_cast<double>(detail::availableMemory());
  if (left > 0 && needed > left)
    throw Error(fmt::format(
        "{} levels make {:.4g} vertices, which take some {:.0f} MB; the limit is the {:.0f} MB that are left",
        options.levels, counts.vertices, needed / kMegabyte, left / kMegabyte));
}

/// Counts what is special, and refuses what Catmull-Clark's scheme makes no smooth surface of.
void lookAtVertices(const detail::HalfEdges& topology, const SubdivideOptions& options, SubdivideReport& report) {
  const bool triangles = options.scheme == SubdivisionScheme::kLoop;
  for (std::uint32_t e = 0; e < topology.edges; ++e) {
    const bool boundary = topology.twin[topology.half[e]] == detail::kNoHalfEdge;
    report.boundaryEdges += boundary;
    report.creaseEdges += !boundary && topology.sharp[e] != 0;
  }
  for (std::uint32_t v = 0; v < topology.vertices; ++v) {
    std::size_t spokes = 0;
    bool inside = true;
    topology.forEachSpoke(v, [&](std::uint32_t, std::uint32_t, std::uint32_t h) {
      ++spokes;
      inside &= h != detail::kNoHalfEdge;
    });
    report.extraordinaryVertices += inside && spokes != (triangles ? 6 : 4);
    if (inside && spokes == 2 && !triangles && options.covariances)
      throw Error(
          fmt::format("vertex {} lies inside the surface with 2 faces; Catmull-Clark subdivision with "
                      "covariances takes 3 and more",
                      v));
  }
}

/// The vertices given, as points or Gaussians.
template <typename Value>
Buffer<Value> startValues(const Mesh& mesh, const Buffer<SymMat3<double>>& covariances) {
  Buffer<Value> values(mesh.positions.size());
  detail::forEachInParallel(values.size(), kGrain, [&](std::uint32_t v) {
    const Vec3d p = vecCast<double>(mesh.positions[v]);
    if constexpr (std::is_same_v<Value, Vec3d>) {
      values[v] = p;
    } else {
      // What is no covariance was refused before.
      values[v] = Gaussian::fromCovariance(p, covariances[v]).value_or(Gaussian{p, SymMat3<double>::identity()});
    }
  });
  return values;
}

template <typename Value>
void writeVertices(const Buffer<Value>& values, const SubdivideOptions& options, SubdivideReport& report, Mesh& mesh) {
  mesh.positions.resize(values.size());
  detail::forEachInParallel(values.size(), kGrain,
                            [&](std::uint32_t v) { mesh.positions[v] = vecCast<float>(detail::placeOf(values[v])); });
  if (options.keepPlaces) {
    report.places.resize(values.size());
    for (std::size_t v = 0; v < values.size(); ++v) report.places[v] = detail::placeOf(values[v]);
  }
  if constexpr (std::is_same_v<Value, Gaussian>) {
    if (!options.keepCovariances) return;
    Buffer<SymMat3<double>> covariances(values.size());
    detail::forEachInParallel(values.size(), kGrain, [&](std::uint32_t v) { covariances[v] = values[v].covariance(); });
    setVertexCovariances(mesh, covariances);
  }
}

template <typename Value>
void toLimit(const detail::HalfEdges& topology, const SubdivideOptions& options, detail::BlockProgress& progress,
             SubdivideReport& report, Buffer<Value>& values, Mesh& mesh) {
  detail::LimitSurface<Value> limit = detail::limitSurface(topology, values, options, progress);
  values = std::move(limit.vertices);
  mesh.normals = std::move(limit.normals);
  if (!options.curvature) return;
  report.estimatedCurvatures = limit.estimatedCurvatures;
  mesh.properties.push_back({"mean_curvature", 1, std::move(limit.meanCurvature)});
  mesh.properties.push_back({"gaussian_curvature", 1, std::move(limit.gaussianCurvature)});
}

template <typename Value>
Mesh refine(detail::HalfEdges topology, Buffer<Value> values, const SubdivideOptions& options, SubdivideReport& report,
            const Monitor& monitor) {
  const bool triangles = options.scheme == SubdivisionScheme::kLoop;
  double total = 0;
  for (int level = 1; level <= options.levels + (options.limit ? 1 : 0); ++level)
    total += detail::countRefined(topology, triangles, std::min(level, options.levels)).vertices;
  detail::BlockProgress progress(monitor, "subdivide", static_cast<std::size_t>(total));
  Mesh result;
  for (int level = 1; level <= options.levels; ++level) {
    values = triangles ? detail::refineLoop(topology, options.weights, values, progress)
                       : detail::refineCatmullClark(topology, values, progress);
    if (level == options.levels) {
      if (triangles) {
        result.triangles = detail::refinedTriangles(topology);
      } else {
        result.quads = detail::refinedQuads(topology);
      }
    }
    if (level < options.levels || options.limit)
      topology = triangles ? detail::refineTriangles(topology) : detail::refinePolygons(topology);
  }
  if (options.limit) toLimit(topology, options, progress, report, values, result);
  topology = {};
  writeVertices(values, options, report, result);
  return result;
}

}  // namespace

Mesh subdivide(const Mesh& mesh, const SubdivideOptions& options, SubdivideReport* report, const Monitor& monitor) {
  detail::checkSizes(mesh, "subdivide", detail::FaceKinds::kAll);
  checkOptions(options);
  SubdivideReport own;
  SubdivideReport& said = report == nullptr ? own : *report;
  said = {};
  Mesh input = takeInput(mesh, options.scheme, said);
  Buffer<SymMat3<double>> covariances;
  if (options.covariances) covariances = inferCovariances(input, *options.covariances, monitor);
  dropUnused(input, covariances, said);
  detail::checkFinite(input);
  detail::HalfEdges topology = detail::makeHalfEdges(input, options.creaseAngle.value_or(180));
  said.facesBefore = topology.faces;
  said.verticesBefore = topology.vertices;
  checkSize(topology, options);
  lookAtVertices(topology, options, said);
  Mesh result = options.covariances
                    ? refine(std::move(topology), startValues<Gaussian>(input, covariances), options, said, monitor)
                    : refine(std::move(topology), startValues<Vec3d>(input, covariances), options, said, monitor);
  result.origin = input.origin;
  said.facesAfter = detail::faceCount(result);
  said.verticesAfter = result.positions.size();
  return result;
}

}  // namespace pdc
