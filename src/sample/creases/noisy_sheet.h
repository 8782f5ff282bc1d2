#pragma once

#include "sample/creases/crease_sheets.h"

namespace pdc::detail {

/// Fits a side to the samples it is made of once more, where their noise is known: a paraboloid over the side's tangent
/// plane, by least squares of the heights of their feet and of the slopes of their normals, each by its noise, with
/// bends expected to be small. Heights say better how a side leans and bends than normals, which are made of
/// differences, but only as far as it is a paraboloid: on exact samples normals alone are better.
/// \param share how much of each sample is the side's. \param normalNoise as for findSides; positive. \returns the
/// side, with the same centre and weight.
[[nodiscard]] SurfaceSide fitNoisySide(const SurfaceSamples& samples, const float* share, const SurfaceSide& side,
                                       double normalNoise, SimdLevel level = bestSimdLevel());

}  // namespace pdc::detail
