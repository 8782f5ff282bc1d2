#include "pdc/smooth/smooth.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "mesh/faces.h"
#include "mesh/local/standard_deviations.h"
#include "mesh/local/vertex_normals.h"
#include "mesh/mesh_checks.h"
#include "parallel/for_each_in_parallel.h"
#include "pdc/math/solvers.h"
#include "smooth/face_quadrics.h"
#include "smooth/vertex_sigmas.h"

namespace pdc {
namespace {

constexpr std::size_t kGrain = 4096;

/// More noise than this, in mean edges, counts as no more: the quadrics are those of points by then.
constexpr double kMostSigma = 100;

/// Less noise than this that a property says, in mean edges, counts as none: contouring says up to 0.02 voxels at clean
/// creases, which would make them round.
constexpr double kLeastGiven = 0.02;

/// How well the minimum is known, in mean edges: a vertex whose own noise is as large goes half of the way, as in a
/// Kalman filter. Decimation takes noise for as small.
constexpr double kMinimumNoise = 0.01;

/// A vertex goes no farther than this many standard deviations of its coordinates. With 3 contours, whose noise is up
/// to twice what is known of it, keep a tenth more of it; without a limit CAD meshes of few vertices lose their shape.
constexpr double kMostSteps = 8;

/// Eigenvalues that are smaller, as a share of the largest, say nothing where noise does not: the cutoff of Lindstrom
/// 2000.
constexpr double kClassicalCutoff = 1e-3;

void check(const SmoothOptions& o) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(fmt::format("smooth: {}", what));
  };
  require(o.iterations >= 0 && o.iterations <= 1000, "the iterations are not within 0 and 1000");
  require(!o.sigma || (*o.sigma >= 0 && std::isfinite(*o.sigma)), "sigma is not 0 or more");
}

bool isMeasured(const SmoothOptions& options) { return options.sigmaProperty.empty() && !options.sigma; }

std::vector<double> sigmasOf(const Mesh& mesh, const detail::SmoothedSurface& surface, const SmoothOptions& options,
                             detail::BlockProgress& progress) {
  std::vector<double> sigmas;
  if (!options.sigmaProperty.empty()) {
    sigmas = detail::standardDeviations(mesh, options.sigmaProperty);
    for (double& sigma : sigmas) sigma = detail::beyondDoubt(sigma / surface.frame().unit(), kLeastGiven);
  } else if (options.sigma) {
    sigmas.assign(mesh.positions.size(), *options.sigma);
  } else {
    sigmas = detail::measuredSigmas(surface, progress);
  }
  for (double& sigma : sigmas) sigma = std::min(sigma, kMostSigma);
  return sigmas;
}

/// From a vertex to the minimum of the quadric about it; the nearest one where there are several.
Vec3d stepToMinimum(const NormalEquations<double>& q) {
  if (const auto step = solveLdlt(q.A, q.b); step && std::isfinite(dot(*step, *step))) return *step;
  return solvePseudoInverse(q.A, q.b, kClassicalCutoff);
}

double longestEdge(const detail::SmoothedSurface& surface, std::uint32_t vertex) {
  const Buffer<Vec3d>& p = surface.positions();
  double longest = 0;
  for (const detail::Corner& c : surface.corners(vertex))
    longest = std::max({longest, length(p[c.next] - p[vertex]), length(p[c.previous] - p[vertex])});
  return longest;
}

/// Where vertices go, in the local frame. \param[out] limited how many minima were too far away.
Buffer<Vec3d> targetsOf(const detail::FaceQuadrics& quadrics, const detail::SmoothedSurface& surface,
                        const std::vector<double>& sigmas, bool lockBoundary, std::size_t& limited,
                        detail::BlockProgress& progress) {
  Buffer<Vec3d> targets = surface.positions();
  std::atomic<std::size_t> count = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.vertices(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const auto v = static_cast<std::uint32_t>(i);
      if (surface.corners(v).empty() || sigmas[v] == 0 || (lockBoundary && surface.atBoundary(v))) continue;
      Vec3d step = stepToMinimum(quadrics.sumAt(v));
      const double most = std::min(longestEdge(surface, v), kMostSteps * sigmas[v]), wanted = length(step);
      if (wanted > most) {
        step *= most / wanted;
        ++count;
      }
      const double variance = sigmas[v] * sigmas[v];
      targets[v] += step * (variance / (variance + kMinimumNoise * kMinimumNoise));
    }
    progress.advance(range.size());
  });
  limited = count;
  return targets;
}

void noteMoves(const detail::SmoothedSurface& surface, const Buffer<Vec3d>& targets, const std::vector<double>& sigmas,
               SmoothReport& facts) {
  double sigma = 0, move = 0, count = 0;
  for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
    if (surface.corners(v).empty()) continue;
    const double d = length(targets[v] - surface.positions()[v]);
    move += d;
    sigma += sigmas[v];
    count += 1;
    facts.largestMove = std::max(facts.largestMove, d);
    facts.largestSigma = std::max(facts.largestSigma, sigmas[v]);
    facts.boundaryVertices += surface.atBoundary(v);
  }
  facts.meanMove = move / count;
  facts.meanSigma = sigma / count;
}

/// Writes positions; vertices that did not move keep theirs to the last bit.
void moveVertices(Mesh& mesh, const detail::SmoothedSurface& surface, const Buffer<Vec3d>& targets) {
  detail::forEachInParallel(mesh.positions.size(), kGrain, [&](std::uint32_t v) {
    if (!(targets[v] == surface.positions()[v])) mesh.positions[v] = surface.frame().world(targets[v]);
  });
}

}  // namespace

Mesh smooth(const Mesh& mesh, const SmoothOptions& options, SmoothReport* report, const Monitor& monitor) {
  check(options);
  detail::checkSizes(mesh, "smooth");
  detail::checkIndices(mesh);
  SmoothReport own;
  SmoothReport& facts = report != nullptr ? *report : own;
  facts = {};
  monitor.throwIfStopped();
  const detail::SmoothedSurface surface(mesh, monitor);
  facts.vertices = mesh.positions.size();
  facts.triangles = detail::triangleCount(mesh);
  facts.degenerateFaces = facts.triangles - surface.triangles().size();
  facts.meanEdge = surface.frame().unit();

  const auto passes = static_cast<std::size_t>(options.iterations) + 1;
  const std::size_t vertexPasses = isMeasured(options) ? 1 + detail::kMeasuringPasses : 1;
  detail::BlockProgress progress(monitor, "smooth", surface.faces() * passes + surface.vertices() * vertexPasses);
  const std::vector<double> sigmas = sigmasOf(mesh, surface, options, progress);
  detail::FaceQuadrics quadrics(surface, sigmas, options.normaliseArea, progress);
  const auto averaging = options.plain ? detail::Averaging::kPlain : detail::Averaging::kByNoise;
  for (int i = 0; i < options.iterations; ++i) quadrics.average(averaging, progress);
  const Buffer<Vec3d> targets =
      targetsOf(quadrics, surface, sigmas, options.lockBoundary, facts.limitedMoves, progress);
  noteMoves(surface, targets, sigmas, facts);
  Mesh result = mesh;
  moveVertices(result, surface, targets);
  if (!result.normals.empty()) result.normals = detail::vertexNormals(result);
  return result;
}

}  // namespace pdc
