#include "pdc/simplify/decimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "mesh/faces.h"
#include "mesh/local/vertex_normals.h"
#include "mesh/mesh_checks.h"
#include "pdc/math/box.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/weld_vertices.h"
#include "simplify/decimation/decimation.h"
#include "simplify/decimation/surface_fit.h"
#include "simplify/mesh_noise.h"
#include "simplify/pair_contraction/pair_contraction.h"

namespace pdc {
namespace {

bool isLength(const std::optional<MeshLength>& l) { return !l || (l->value > 0 && std::isfinite(l->value)); }

double inWorld(const MeshLength& length, double meanEdge) {
  // Longer ones than double precision holds come to the same.
  return std::min(length.value * (length.inMeanEdges ? meanEdge : 1), std::numeric_limits<double>::max());
}

void check(const DecimateOptions& o) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(fmt::format("decimate: {}", what));
  };
  require(o.faces || o.ratio || o.error, "neither a number of faces nor a ratio nor an error is set");
  require(isLength(o.error), "the error is not above 0 and finite");
  require(o.errorScale.empty() || o.error, "a scale of the error is named without an error");
  require(!o.ratio || (*o.ratio > 0 && *o.ratio <= 1), "the ratio is not above 0 and at most 1");
  require(!o.sigmaNormal || (*o.sigmaNormal >= 0 && std::isfinite(*o.sigmaNormal)), "sigma_n is not 0 or more");
  require(!o.sigmaPosition || (*o.sigmaPosition >= 0 && std::isfinite(*o.sigmaPosition)), "sigma_p is not 0 or more");
  require(!o.memory || (*o.memory >= 0 && *o.memory <= 1), "the memory is not within 0 and 1");
  require(!o.weld || (*o.weld >= 0 && std::isfinite(*o.weld)), "the distance to weld within is not 0 or more");
  require(o.maxTurn > 0 && o.maxTurn <= 90, "the largest turn is not above 0 and at most 90 degrees");
  require(o.boundaryWeight >= 0 && std::isfinite(o.boundaryWeight), "the boundary's weight is not 0 or more");
  require(o.positionStep >= 0 && std::isfinite(o.positionStep), "the step of positions is not 0 or more");
  require(!o.pairDistance || o.positionStep == 0, "with a distance of pairs positions have no step");
  require(isLength(o.pairDistance), "the distance of pairs is not above 0 and finite");
  require(!o.pairDistance || !o.sound, "with a distance of pairs nothing keeps faces from intersecting");
  require(!o.pairDistance || !o.error, "with a distance of pairs nothing bounds the error");
  require(!o.pairDistance || o.memory.value_or(1) == 1, "with a distance of pairs the memory is 1");
}

/// The triangles of a mesh that name three vertices, all finite.
Buffer<Triangle> usableTriangles(const Mesh& mesh) {
  Buffer<Triangle> faces;
  faces.reserve(detail::triangleCount(mesh));
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const Triangle t = detail::triangle(mesh, i);
    const bool finite =
        std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return detail::isFinite(mesh.positions[v]); });
    if (finite && t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) faces.push_back(t);
  }
  return faces;
}

/// Vertices about which the surface is none stay, and at its boundary if so wanted. \returns how many of the former.
std::size_t lockVertices(detail::DecimatedSurface& surface, const detail::VertexStars& stars, bool boundary) {
  std::size_t nonManifold = 0;
  surface.locked.resize(surface.positions.size());
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    const bool manifold = detail::isManifoldStar(stars[v]);
    nonManifold += !manifold;
    surface.locked[v] = !manifold || (boundary && detail::atBoundary(stars[v]));
  }
  return nonManifold;
}

/// The choices that the surface's noise makes, as it is known or as it is measured; of what is known, in the mean.
void chooseNoise(const detail::DecimatedSurface& surface, const detail::VertexStars& stars,
                 const DecimateOptions& options, DecimateReport& report) {
  const bool known = surface.noise.known();
  report.noise = known ? surface.noise.mean() : detail::meshNoise(stars, surface.positions);
  const detail::NoiseChoice choice =
      detail::choiceFor(report.noise, known ? detail::kFadeGiven : detail::kFadeMeasured);
  report.sigmaNormal = options.sigmaNormal.value_or(choice.sigmaNormal);
  report.sigmaPosition = options.sigmaPosition.value_or(choice.sigmaPosition);
  report.memory = options.memory.value_or(choice.memory);
}

/// The mesh of what is left, its vertices in the order they had.
Mesh meshOf(const detail::DecimatedSurface& surface, const detail::InterpolatedProperties& properties,
            const Mesh& given) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> number(surface.positions.size(), kUnused), used;
  for (const Triangle& t : surface.faces)
    for (const std::uint32_t v : t) number[v] = 0;
  Mesh mesh;
  mesh.origin = given.origin;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(used.size());
    used.push_back(v);
    mesh.positions.push_back(surface.written(v, surface.positions[v]));
  }
  for (const Triangle& t : surface.faces) mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  mesh.properties = properties.of(used);
  if (!given.normals.empty()) mesh.normals = detail::vertexNormals(mesh);
  return mesh;
}

std::size_t targetOf(const DecimateOptions& options, std::size_t faces) {
  const std::size_t asShare =
      options.ratio ? static_cast<std::size_t>(*options.ratio * static_cast<double>(faces)) : std::size_t{0};
  return std::max(asShare, options.faces.value_or(0));
}

/// Welds a copy first. Faces wanted are counted as a share of those given, before that.
Mesh decimateWelded(const Mesh& mesh, const DecimateOptions& options, DecimateReport& facts, const Monitor& monitor) {
  Mesh welded = mesh;
  const WeldReport weld = weldVertices(welded, *options.weld, monitor);
  DecimateOptions rest = options;
  rest.weld.reset();
  rest.ratio.reset();
  rest.faces = targetOf(options, detail::triangleCount(mesh));
  Mesh result = decimate(welded, rest, &facts, monitor);
  facts.degenerateFaces += detail::triangleCount(mesh) - detail::triangleCount(welded);
  facts.facesBefore = detail::triangleCount(mesh);
  facts.verticesBefore = mesh.positions.size();
  facts.weldedVertices = weld.weldedVertices;
  return result;
}

/// What decimate() does where there is a distance of pairs.
Mesh contractPairs(detail::DecimatedSurface& surface, const Mesh& mesh, const DecimateOptions& options,
                   DecimateReport& facts, const Monitor& monitor) {
  facts.memory = 1;
  const auto meshOfFaces = [&] {
    Mesh part;
    part.positions = mesh.positions;
    part.triangles = surface.faces;
    return part;
  };
  const std::size_t componentsBefore = analyze(meshOfFaces(), monitor).components;
  detail::InterpolatedProperties properties(mesh);
  const detail::PairContractionRule rule{
      targetOf(options, facts.facesBefore),
      {options.quadric, facts.sigmaNormal, facts.sigmaPosition, options.boundaryWeight},
      inWorld(*options.pairDistance, facts.meanEdge) / surface.frame.unit(),
      options.placement == CollapsePlacement::kSubset,
      std::cos(options.maxTurn * std::numbers::pi / 180),
      options.lockBoundary};
  detail::PairContraction contraction(surface.positions, surface.faces, properties, rule);
  contraction.run(monitor);
  Mesh result = meshOf(surface, properties, mesh);
  facts.facesAfter = result.triangles.size();
  facts.verticesAfter = result.positions.size();
  facts.end = facts.facesAfter <= rule.targetFaces ? DecimateEnd::kReached : DecimateEnd::kNoCollapseLeft;
  facts.collapses = contraction.contractions();
  facts.limitedMoves = contraction.limitedMoves();
  const MeshReport after = analyze(result, monitor);
  facts.pairs = {contraction.merges(), contraction.duplicates(), componentsBefore,
                 after.components,     after.nonManifoldEdges,   after.nonManifoldVertices};
  return result;
}

/// The surface of a mesh's usable faces, and what the report says of it.
detail::DecimatedSurface surfaceOf(const Mesh& mesh, const DecimateOptions& options, DecimateReport& facts) {
  detail::DecimatedSurface surface;
  surface.faces = usableTriangles(mesh);
  facts.degenerateFaces = facts.facesBefore - surface.faces.size();
  surface.frame = detail::LocalFrame(mesh, surface.faces);
  surface.frame.setStep(options.positionStep);
  facts.meanEdge = surface.frame.unit();
  surface.positions.reserve(mesh.positions.size());
  for (const Vec3f& p : mesh.positions) surface.positions.push_back(surface.frame.local(p));
  surface.given = mesh.positions;
  detail::VertexStars stars;
  stars.build(surface.faces, surface.positions.size());
  facts.nonManifoldVertices = lockVertices(surface, stars, options.lockBoundary);
  if (!options.sigmaProperty.empty())
    surface.noise = detail::VertexNoise(mesh, options.sigmaProperty, surface.frame.unit());
  chooseNoise(surface, stars, options, facts);
  return surface;
}

/// What decimate() does otherwise.
Mesh collapseEdges(detail::DecimatedSurface& surface, const Mesh& mesh, const DecimateOptions& options,
                   DecimateReport& facts, const Monitor& monitor) {
  const detail::DecimationRule rule{
      targetOf(options, facts.facesBefore),
      options.error ? std::optional(detail::errorLimits(mesh, surface.faces, inWorld(*options.error, facts.meanEdge),
                                                        options.errorScale))
                    : std::nullopt,
      {options.quadric, facts.sigmaNormal, facts.sigmaPosition, options.boundaryWeight},
      facts.memory,
      !options.sigmaNormal,
      !options.memory,
      options.placement == CollapsePlacement::kSubset,
      std::cos(options.maxTurn * std::numbers::pi / 180),
      options.sound};
  const detail::GivenSurface given{surface.positions, surface.faces};
  detail::InterpolatedProperties properties(mesh);
  std::vector<std::uint32_t> became;
  {
    detail::Decimation decimation(surface, given, properties, rule);
    decimation.run(monitor);
    facts.rounds = decimation.rounds();
    facts.collapses = decimation.collapses();
    facts.limitedMoves = decimation.limitedMoves();
    facts.refusedIntersections = decimation.intersectionRefusals();
    facts.refusedErrors = decimation.errorRefusals();
    became = decimation.takeBecame();
  }
  if (options.placement == CollapsePlacement::kMinimizer && options.fit && !options.error) {
    detail::fitSurface(surface, given,
                       {became, rule.leastCosine, facts.sigmaNormal, !options.sigmaNormal, options.sound}, monitor);
  }
  Mesh result = meshOf(surface, properties, mesh);
  facts.facesAfter = result.triangles.size();
  facts.verticesAfter = result.positions.size();
  facts.error = rule.error ? rule.error->distance() : 0;
  facts.end = facts.facesAfter <= rule.targetFaces ? DecimateEnd::kReached
              : facts.refusedErrors > 0            ? DecimateEnd::kError
                                                   : DecimateEnd::kNoCollapseLeft;
  return result;
}

}  // namespace

Mesh decimate(const Mesh& mesh, const DecimateOptions& options, DecimateReport* report, const Monitor& monitor) {
  check(options);
  detail::checkSizes(mesh, "decimate");
  detail::checkIndices(mesh);
  DecimateReport own;
  DecimateReport& facts = report != nullptr ? *report : own;
  facts = {};
  if (options.weld) return decimateWelded(mesh, options, facts, monitor);
  facts.facesBefore = detail::triangleCount(mesh);
  facts.verticesBefore = mesh.positions.size();
  monitor.throwIfStopped();
  detail::DecimatedSurface surface = surfaceOf(mesh, options, facts);
  return options.pairDistance ? contractPairs(surface, mesh, options, facts, monitor)
                              : collapseEdges(surface, mesh, options, facts, monitor);
}

}  // namespace pdc
