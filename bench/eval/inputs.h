#pragma once

#include <openvdb/openvdb.h>

#include <functional>
#include <string>
#include <vector>

#include "eval/shapes.h"

namespace pdc::eval {

/// Kinds of sampled input: "exact" distances; "half", the same rounded to half precision; "iso", distances plus one
/// voxel, to be contoured at 1; "mesh", openvdb::tools::meshToVolume of a fine mesh.
[[nodiscard]] const std::vector<std::string>& gridInputs();

struct GridInput {
  openvdb::FloatGrid::Ptr grid;
  double iso;
  openvdb::FloatGrid::Ptr sigma = nullptr;  ///< Standard deviation of each value, if it is not the same for all.
};

/// A level set of half width 3 on the lattice of integer points. \param noise standard deviation of what is added to
/// every active value, in voxels. \param seed chooses the noise.
[[nodiscard]] GridInput makeGrid(const std::string& input, const Shape& shape, const Pose& pose, double noise,
                                 unsigned seed);

/// A grid of a solid's distances about the origin: "level_set" of half width 3, or "fog", which falls from 1 to 0
/// within 1.5 voxels of the surface. \param reach of the solid from the origin, in voxels.
[[nodiscard]] GridInput makeClean(const std::string& input, const std::function<double(const Vec3d&)>& distance,
                                  double reach);

/// A copy with noise in every active value, and rounded to half precision if asked for. \param noise in voxels.
[[nodiscard]] GridInput withNoise(const GridInput& clean, double noise, bool half, unsigned seed);

/// Exact distances with noise that grows along x, from 0 where the solid begins to `noise` where it ends, with a σ
/// grid.
[[nodiscard]] GridInput makeGradedGrid(const Shape& shape, const Pose& pose, double noise, unsigned seed);

}  // namespace pdc::eval
