#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "pdc/points/point_cloud.h"

namespace pdc {

struct PointsReadOptions {
  /// Called with a line that names the file, for each thing in it that is odd or was not read.
  std::function<void(const std::string&)> warn = {};
};

/// Reads points, by suffix:
///
/// - `.ply`: the vertices of what readMesh() reads; faces are left out. Colours are "red", "green" and "blue" (uint8),
///   standard deviations "sigma".
/// - `.xyz`, `.pts` and `.txt`: a point per line, after a line with their number or without one; `#` and `//` begin
///   comments, commas count as blanks. x y z; x y z value; x y z nx ny nz, or x y z r g b where all of the three are
///   whole numbers from 0 to 255 and some is above 1; x y z value r g b; x y z nx ny nz r g b, or the other way round.
///   All lines have as many numbers as the first. Values (intensities) are left out.
/// - `.pcd`: ascii and binary, not compressed. normal_x normal_y normal_z, rgb or rgba, sigma.
/// - `.vdb`: all points of the file's only point grid, in world space; attributes N and Cd.
///
/// Points with a coordinate that is not finite, as scanners give for rays that met nothing, are left out with a
/// warning; normals that are not finite become zero, others get unit length. Standard deviations that are none become
/// 0.
///
/// \throws Error for a missing, empty or damaged file, an unknown suffix and a file without points, naming the file.
/// Trees of point grids are read by OpenVDB, unchecked but for the file's length.
[[nodiscard]] PointCloud readPoints(const std::filesystem::path& path, const PointsReadOptions& options = {});

/// Whether the suffix is one that readPoints() takes. \throws Error that names those that it takes.
void checkPointsPath(const std::filesystem::path& path);

}  // namespace pdc
