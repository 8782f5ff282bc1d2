#pragma once

#include <cstddef>
#include <vector>

#include "pdc/mesh/mesh.h"
#include "pdc/points/gaussian_mixture.h"

namespace pdc::detail {

// What is done to triangles over the Gaussians of a mixture once no more are found. Edges have at most two triangles,
// and all are turned the same way.

/// Adds a vertex where the triangles about one make more than one fan, so that all do. \returns how many were added.
std::size_t splitVertices(GaussianMixture& mixture, std::vector<Triangle>& triangles);

/// The number of a component for each Gaussian; those without triangles have one of their own each.
[[nodiscard]] std::vector<std::uint32_t> componentsOf(std::size_t gaussians, const std::vector<Triangle>& triangles);

/// \returns how many triangles were dropped.
std::size_t dropSmallComponents(std::size_t gaussians, std::vector<Triangle>& triangles, std::size_t least);

/// Boundaries, each as its vertices in the direction that triangles to fill it would have. Every vertex has one fan.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> boundaryLoops(std::size_t gaussians,
                                                                    const std::vector<Triangle>& triangles);

/// Closes boundaries ear by ear, the shortest new edge first, and by a fan about their middle where no ear is left.
/// \returns how many Gaussians were added.
std::size_t fillLoops(GaussianMixture& mixture, std::vector<Triangle>& triangles,
                      const std::vector<std::vector<std::uint32_t>>& loops);

/// Turns each component the way that normals point, or, without normals, away from the middle of all
/// Gaussians.
void orient(const GaussianMixture& mixture, std::vector<Triangle>& triangles);

}  // namespace pdc::detail
