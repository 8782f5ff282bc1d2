#pragma once

#include "sample/creases/crease_sheets.h"

namespace pdc::detail {

struct NoisyFit {
  CreaseSheet sheet;
  double heightError;  ///< The sum of the squares of what is left of the samples' heights, by their fit weights.
};

/// Fits a sheet to the samples it is made of once more, where their noise is known: a paraboloid over the sheet's
/// tangent plane, by least squares of the heights of their foot points and of the slopes of their normals, by their
/// noise, with bends expected to be small. Heights say better how a sheet leans and bends than normals, which are made
/// of differences, but only as far as it is a paraboloid: on exact samples normals alone are better. \param fitWeight
/// of each sample in the sheet; 0 for samples of others. \param normalNoise as for findSheets; positive. \returns the
/// sheet, with the same centre and support.
[[nodiscard]] NoisyFit fitNoisySheet(const SurfaceSamples& samples, const float* fitWeight, const CreaseSheet& sheet,
                                     double normalNoise, SimdLevel level = bestSimdLevel());

}  // namespace pdc::detail
