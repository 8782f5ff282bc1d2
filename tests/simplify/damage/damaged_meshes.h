#pragma once

#include <cstdint>

#include "pdc/mesh/mesh.h"

namespace pdc::test {

/// A small mesh with several kinds of damage: corners that name other vertices or none, coordinates that are NaN,
/// infinite, huge or denormal, vertices and faces twice, holes, faces turned over, fans of many faces at an edge,
/// pinches, parts that are not joined. \param seed decides all.
[[nodiscard]] Mesh damagedMesh(std::uint32_t seed);

/// A mesh without a volume, an area, a length or a scale that computers like: all vertices in one point, on one line or
/// in one plane, slivers, lengths from 1e-38 to 1e38, and places far from the origin. Each face names three vertices
/// that there are.
[[nodiscard]] Mesh degenerateMesh(std::uint32_t seed);

}  // namespace pdc::test
