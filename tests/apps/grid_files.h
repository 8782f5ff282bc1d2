#pragma once

#include <filesystem>

namespace pdc::test {

/// A level set of a sphere of radius 1 about the origin, voxel size 0.1.
struct SphereFile {
  int nanVoxels = 0;        ///< That many voxels of the surface, from the first in memory order, become NaN.
  int infiniteVoxels = 0;   ///< That many more become infinite.
  bool vectorGrid = false;  ///< Holds a vec3s grid instead.
  bool twoGrids = false;    ///< Holds the same grid a second time under the name "other"; the first is "sphere".
  /// Holds further grids: "sigma", 0.02 where the sphere is active and x > 0, else 0; "weight", 1 there; "halved", 1
  /// there where x > 0; "moved", of another transform; "faulty", -1 there.
  bool noiseGrids = false;
  /// Holds further grids: "scale", with voxels of 0.25, 1 where x > 0, else its background 0.1; "mask", of bools.
  bool scaleGrids = false;
  bool positiveInside = false;  ///< All values have the other sign; the class stays.
  bool floodFilled = true;      ///< False: all inactive values are the background.
  double offset = 0;            ///< Moves the centre along x, through the grid's transform.
};

void writeSphere(const std::filesystem::path& path, const SphereFile& content = {});

}  // namespace pdc::test
