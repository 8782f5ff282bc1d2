#include "reports/mesh_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "mesh/components.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"

namespace pdc {
namespace {

void checkPrecision(const Input& input, const Mesh& mesh, const std::string& remedy, std::vector<std::string>& lines) {
  float farthest = 0;
  for (const Vec3f& p : mesh.positions) {
    farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  if (!std::isfinite(farthest)) throw Error("coordinates lie beyond what single precision holds, 3.4e38");
  const double spacing = std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest;
  const double inVoxels = spacing / input.source->map().voxelSize();
  if (inVoxels > kMostRounding)
    lines.push_back(
        fmt::format("far from the origin: at coordinate {:.6g} single precision has steps of {:.2g} voxels; {}",
                    farthest, inVoxels, remedy));
}

void checkSpecks(const Mesh& mesh, const std::string& remedy, std::vector<std::string>& lines) {
  constexpr std::size_t kMany = 1000, kMostVertices = 24;
  const std::vector<std::uint32_t> sizes = detail::componentSizes(mesh);
  const auto specks = static_cast<std::size_t>(
      std::count_if(sizes.begin(), sizes.end(), [](std::size_t size) { return size <= kMostVertices; }));
  if (specks >= kMany)
    lines.push_back(fmt::format("{} of {} separate surfaces are specks of at most {} vertices; {}", specks,
                                sizes.size(), kMostVertices, remedy));
}

}  // namespace

std::vector<std::string> meshWarnings(const Input& input, const Mesh& mesh, const MeshRemedies& remedies) {
  std::vector<std::string> lines;
  checkPrecision(input, mesh, remedies.precision, lines);
  checkSpecks(mesh, remedies.specks, lines);
  return lines;
}

std::size_t verticesOnBox(const Input& input, const Mesh& mesh) {
  constexpr double kNear = 0.02;  // voxels
  if (!input.cut) return 0;
  const double near = kNear * input.source->map().voxelSize();
  return static_cast<std::size_t>(std::count_if(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3f& p) {
    const Vec3d world = mesh.origin + vecCast<double>(p);
    bool on = false;
    for (int axis = 0; axis < 3; ++axis)
      on = on || world[axis] < input.cut->lo[axis] + near || world[axis] > input.cut->hi[axis] - near;
    return on;
  }));
}

}  // namespace pdc
