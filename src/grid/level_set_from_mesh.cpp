#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "grid/level_set.h"
#include "grid/monitor_interrupter.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// Coordinates of a lattice stay well within 32 bits, stencils included.
constexpr double kFarthest = 1 << 30;

/// A mesh as openvdb::tools::meshToVolume() takes it.
class MeshData {
 public:
  MeshData(const Mesh& mesh, const openvdb::math::Transform& transform) : mMesh(mesh), mTransform(transform) {}

  [[nodiscard]] std::size_t polygonCount() const { return mMesh.quads.size() + mMesh.triangles.size(); }
  [[nodiscard]] std::size_t pointCount() const { return mMesh.positions.size(); }
  [[nodiscard]] std::size_t vertexCount(std::size_t n) const { return n < mMesh.quads.size() ? 4 : 3; }
  void getIndexSpacePoint(std::size_t n, std::size_t v, openvdb::Vec3d& position) const {
    const std::size_t quads = mMesh.quads.size();
    position = point(n < quads ? mMesh.quads[n][v] : mMesh.triangles[n - quads][v]);
  }
  /// In index space.
  [[nodiscard]] openvdb::Vec3d point(std::size_t v) const {
    const Vec3d p = mMesh.origin + vecCast<double>(mMesh.positions[v]);
    return mTransform.worldToIndex(openvdb::Vec3d(p.x, p.y, p.z));
  }

 private:
  const Mesh& mMesh;
  const openvdb::math::Transform& mTransform;
};

/// How many voxels lie in a band about the faces, roughly: by their areas, slivers by their lengths.
double voxelsAbout(const MeshData& data, double halfWidth) {
  double voxels = 0;
  for (std::size_t n = 0; n < data.polygonCount(); ++n) {
    std::array<openvdb::Vec3d, 4> corner;
    const std::size_t count = data.vertexCount(n);
    for (std::size_t v = 0; v < count; ++v) data.getIndexSpacePoint(n, v, corner[v]);
    double twice = 0, longest = 0;
    for (std::size_t v = 2; v < count; ++v) {
      const openvdb::Vec3d a = corner[v - 1] - corner[0], b = corner[v] - corner[0];
      twice += a.cross(b).length();
      longest = std::max({longest, a.length(), b.length()});
    }
    voxels += halfWidth * std::max(twice, longest);
  }
  return voxels;
}

/// Refuses what would take all memory before it does.
void checkSize(const MeshData& data, double halfWidth) {
  for (std::size_t v = 0; v < data.pointCount(); ++v) {
    const openvdb::Vec3d p = data.point(v);
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(p[axis]) < kFarthest))
        throw Error(
            fmt::format("a vertex lies {:.3g} voxels from the origin; at most {:.3g}", std::abs(p[axis]), kFarthest));
  }
  checkVoxels(voxelsAbout(data, halfWidth), kBandBytes);
}

template <typename GridT>
openvdb::GridBase::Ptr convert(const MeshData& data, const openvdb::math::Transform& transform, double halfWidth,
                               const Monitor& monitor) {
  // Without a face the tool makes no background that is a distance.
  if (data.polygonCount() == 0) {
    auto empty = GridT::create(static_cast<typename GridT::ValueType>(halfWidth * transform.voxelSize()[0]));
    empty->setTransform(transform.copy());
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    return empty;
  }
  MonitorInterrupter interrupter(monitor, "measuring distances");
  openvdb::util::NullInterrupter& base = interrupter;
  const auto width = static_cast<float>(halfWidth);
  auto grid =
      openvdb::tools::meshToVolume<GridT>(base, data, transform, width, width, openvdb::tools::DISABLE_RENORMALIZATION);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

}  // namespace

openvdb::GridBase::Ptr levelSetFromMesh(const Mesh& mesh, const openvdb::math::Transform& transform, double halfWidth,
                                        bool doubles, const Monitor& monitor) {
  const MeshData data(mesh, transform);
  checkSize(data, halfWidth);
  return doubles ? convert<openvdb::DoubleGrid>(data, transform, halfWidth, monitor)
                 : convert<openvdb::FloatGrid>(data, transform, halfWidth, monitor);
}

}  // namespace pdc::detail
