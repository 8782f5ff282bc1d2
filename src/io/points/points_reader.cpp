#include "pdc/io/points/points_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <variant>

#include "io/file/file_error.h"
#include "io/file/read_file.h"
#include "io/file/suffix.h"
#include "io/points/pcd_points.h"
#include "io/points/text_points.h"
#include "io/points/vdb_points.h"
#include "parallel/machine_memory.h"
#include "pdc/io/mesh/mesh_reader.h"

namespace pdc {
namespace {

bool isText(const std::string& suffix) { return suffix == ".xyz" || suffix == ".pts" || suffix == ".txt"; }

/// The vertices of a mesh; without a sigma that is one number per vertex there are no standard deviations.
PointCloud cloudOf(const Mesh& mesh) {
  PointCloud cloud;
  cloud.positions.resize(mesh.positions.size());
  for (std::size_t i = 0; i < cloud.positions.size(); ++i)
    cloud.positions[i] = mesh.origin + vecCast<double>(mesh.positions[i]);
  cloud.normals = mesh.normals;
  const VertexProperty* const sigma = mesh.property("sigma");
  if (sigma != nullptr && sigma->components == 1)
    std::visit(
        [&](const auto& values) {
          for (const auto value : values) cloud.sigmas.push_back(static_cast<float>(value));
        },
        sigma->values);
  const auto red = mesh.values<std::uint8_t>("red"), green = mesh.values<std::uint8_t>("green"),
             blue = mesh.values<std::uint8_t>("blue");
  if (red.size() == cloud.positions.size() && green.size() == red.size() && blue.size() == red.size())
    for (std::size_t i = 0; i < red.size(); ++i) cloud.colours.push_back({red[i], green[i], blue[i]});
  return cloud;
}

/// What is no mesh; errors get the file's name.
PointCloud readNamed(const std::filesystem::path& path, const std::string& suffix) {
  try {
    if (suffix == ".vdb") return detail::readVdbPoints(path);
    Buffer<char> bytes = detail::readFile(path);
    return isText(suffix) ? detail::readTextPoints(bytes) : detail::readPcdPoints({bytes.data(), bytes.size()});
  } catch (const std::bad_alloc&) {
    throw detail::fileError(path, "does not fit into memory: " + detail::memoryFigures());
  } catch (const std::exception& error) {
    throw detail::fileError(path, error.what());
  }
}

/// Leaves out points that are nowhere. \returns how many.
std::size_t dropPointsNowhere(PointCloud& cloud) {
  std::size_t kept = 0;
  const auto keep = [&](auto& list, std::size_t i) {
    if (!list.empty()) list[kept] = list[i];
  };
  const std::size_t n = cloud.positions.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d& p = cloud.positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    keep(cloud.positions, i);
    keep(cloud.normals, i);
    keep(cloud.sigmas, i);
    keep(cloud.colours, i);
    ++kept;
  }
  const auto shorten = [&](auto& list) { list.resize(list.empty() ? 0 : kept); };
  shorten(cloud.positions);
  shorten(cloud.normals);
  shorten(cloud.sigmas);
  shorten(cloud.colours);
  return n - kept;
}

void mendNormals(PointCloud& cloud) {
  for (Vec3f& normal : cloud.normals) {
    const Vec3d n = vecCast<double>(normal);
    const double size = length(n);
    normal = size > 0 && std::isfinite(size) ? vecCast<float>(n * (1 / size)) : Vec3f{0, 0, 0};
  }
  for (float& sigma : cloud.sigmas)
    if (!(sigma >= 0 && std::isfinite(sigma))) sigma = 0;
}

}  // namespace

void checkPointsPath(const std::filesystem::path& path) {
  const std::string suffix = detail::suffixOf(path);
  if (suffix != ".ply" && suffix != ".pcd" && suffix != ".vdb" && !isText(suffix))
    throw detail::fileError(
        path, fmt::format("suffix \"{}\" is none of points: .ply, .xyz, .pts, .txt, .pcd and .vdb are", suffix));
}

PointCloud readPoints(const std::filesystem::path& path, const PointsReadOptions& options) {
  checkPointsPath(path);
  const std::string suffix = detail::suffixOf(path);
  // The errors of meshes name the file already.
  PointCloud cloud = suffix == ".ply" ? cloudOf(readMesh(path, {.warn = options.warn})) : readNamed(path, suffix);
  const std::size_t dropped = dropPointsNowhere(cloud);
  mendNormals(cloud);
  if (cloud.positions.empty())
    throw detail::fileError(path, dropped == 0 ? "has no points" : "has no points with finite coordinates");
  if (dropped > 0 && options.warn)
    options.warn(detail::fileError(path, fmt::format("{} points are not finite and were left out", dropped)).what());
  return cloud;
}

}  // namespace pdc
