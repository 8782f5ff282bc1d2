#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pdc/sample/hermite_mode.h"
#include "pdc/sample/lattice_map.h"
#include "sample/creases/distance_planes.h"
#include "sample/stencils/distance_reader.h"

namespace pdc::detail {

/// Whether planes beside creases come from distances: as asked for or, where the values may be distances, as a sample
/// of them says. \param someBlocks gives at most so many blocks that hold values. \returns nothing where planes must be
/// taken from crossings. \throws Error if distances are asked for and the map is not affine.
[[nodiscard]] std::optional<DistanceModel> chooseDistanceModel(
    HermiteMode mode, bool mayBeDistance, const std::function<std::vector<Coord>(std::size_t)>& someBlocks,
    const DistanceReader& values, const LatticeMap& map);

/// The model of a block whose values have a known noise: `sigma`, the largest at its crossings, in the units of the
/// values. \returns nothing where there is too much of it.
[[nodiscard]] std::optional<DistanceModel> withNoise(DistanceModel model, double sigma, const LatticeMap& map);

}  // namespace pdc::detail
