#include "pdc/points/triangulate_mixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pdc/error.h"
#include "pdc/math/gaussian_product.h"
#include "points/advancing_front.h"
#include "points/finish_surface.h"
#include "points/growing_surface.h"
#include "points/overlaps.h"

namespace pdc {
namespace {

/// The overlap that is enough where a surface is to be closed.
constexpr double kOverlapToClose = 1e-6;

void check(const GaussianMixture& mixture, const TriangulateOptions& options) {
  if (!(options.leastOverlap > 0 && options.leastOverlap < 1))
    throw std::invalid_argument("triangulate: leastOverlap must be above 0 and below 1");
  if (!(options.leastDihedral > 0 && options.leastDihedral < std::numbers::pi))
    throw std::invalid_argument("triangulate: leastDihedral must be above 0 and below pi");
  const std::size_t n = mixture.size();
  const auto fits = [n](const auto& list) { return list.empty() || list.size() == n; };
  if (mixture.covariances.size() != n || mixture.weights.size() != n || !fits(mixture.normals) ||
      !fits(mixture.colours))
    throw std::invalid_argument("triangulate: the lists of the mixture are not of one length");
  if (n == 0) throw Error("there are no Gaussians");
  for (std::size_t i = 0; i < n; ++i)
    if (!inversePositive(mixture.covariances[i]))
      throw Error(fmt::format("the covariance of Gaussian {} is not positive definite", i));
}

void note(const detail::FrontCounts& counts, TriangulateReport& report) {
  report.seeds += counts.seeds;
  report.nonManifoldRefused += counts.nonManifold;
  report.overlappingRefused += counts.overlapping;
}

std::vector<Triangle> grow(const GaussianMixture& mixture, const TriangulateOptions& options, TriangulateReport& report,
                           const Monitor& monitor) {
  detail::GrowingSurface surface(mixture.means);
  const detail::Overlaps overlaps(mixture, options.leastOverlap, monitor);
  detail::AdvancingFront front(mixture, overlaps, options.leastDihedral, surface);
  front.seed(monitor);
  note(front.counts(), report);
  return surface.triangles();
}

/// Advances the boundaries of a surface with whatever overlap there is, so that they meet each other.
void joinBoundaries(const GaussianMixture& mixture, std::vector<Triangle>& triangles, const TriangulateOptions& options,
                    TriangulateReport& report, const Monitor& monitor) {
  detail::GrowingSurface surface(mixture.means);
  for (const Triangle& t : triangles) surface.add(t);
  const detail::Overlaps overlaps(mixture, std::min(kOverlapToClose, options.leastOverlap), monitor);
  detail::AdvancingFront front(mixture, overlaps, options.leastDihedral, surface);
  front.advance(monitor);
  note(front.counts(), report);
  triangles = surface.triangles();
}

/// Fills the boundaries of at most so many edges. \returns how many are left.
std::size_t fillGaps(GaussianMixture& mixture, std::vector<Triangle>& triangles, std::size_t mostEdges,
                     TriangulateReport& report) {
  auto loops = detail::boundaryLoops(mixture.size(), triangles);
  const std::size_t all = loops.size();
  std::erase_if(loops, [mostEdges](const auto& loop) { return loop.size() > mostEdges; });
  report.filledLoops += loops.size();
  report.addedVertices += detail::fillLoops(mixture, triangles, loops);
  return all - loops.size();
}

/// The Gaussians that have triangles as a mesh.
Mesh meshOf(const GaussianMixture& mixture, std::vector<Triangle> triangles) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(mixture.size(), kUnused);
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) number[v] = 0;
  GaussianMixture used;
  for (std::size_t v = 0; v < mixture.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(used.size());
    used.means.push_back(mixture.means[v]);
    used.covariances.push_back(mixture.covariances[v]);
    used.weights.push_back(mixture.weights[v]);
    if (!mixture.normals.empty()) used.normals.push_back(mixture.normals[v]);
    if (!mixture.colours.empty()) used.colours.push_back(mixture.colours[v]);
  }
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = number[v];
  Mesh mesh = mixtureMesh(used);
  mesh.triangles.assign(triangles.begin(), triangles.end());
  return mesh;
}

std::size_t countUnused(std::size_t gaussians, const std::vector<Triangle>& triangles) {
  std::vector<bool> used(gaussians, false);
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t)
      if (v < gaussians) used[v] = true;
  return gaussians - static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

}  // namespace

Mesh triangulate(const GaussianMixture& mixture, const TriangulateOptions& options, TriangulateReport* report,
                 const Monitor& monitor) {
  check(mixture, options);
  TriangulateReport own;
  std::vector<Triangle> triangles = grow(mixture, options, own, monitor);
  GaussianMixture vertices = mixture;
  own.splitVertices = detail::splitVertices(vertices, triangles);
  own.droppedTriangles = detail::dropSmallComponents(vertices.size(), triangles, options.leastTriangles);
  own.boundaryLoops = fillGaps(vertices, triangles, options.mostGapEdges, own);
  if (options.close && own.boundaryLoops > 0) {
    // Sheets that face each other cannot be joined.
    detail::orient(vertices, triangles);
    joinBoundaries(vertices, triangles, options, own, monitor);
    own.splitVertices += detail::splitVertices(vertices, triangles);
    own.boundaryLoops = fillGaps(vertices, triangles, vertices.size(), own);
  }
  detail::orient(vertices, triangles);
  // Gaussians without triangles are components of their own.
  const auto component = detail::componentsOf(vertices.size(), triangles);
  std::vector<bool> seen(vertices.size(), false);
  for (const Triangle& t : triangles) seen[component[t[0]]] = true;
  own.components = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
  own.unusedGaussians = countUnused(mixture.size(), triangles);
  if (report != nullptr) *report = own;
  return meshOf(vertices, std::move(triangles));
}

}  // namespace pdc
