#include "io/points/vdb_points.h"

#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/vdb/vdb_file.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

using openvdb::points::AttributeHandle;
using openvdb::points::PointDataGrid;
using Leaf = openvdb::points::PointDataTree::LeafNodeType;

/// The name in the file of its only point grid.
std::string findGrid(const std::filesystem::path& path) {
  const VdbFile file(path);
  const std::string type = PointDataGrid::gridType();
  std::string found;
  for (const VdbEntry& entry : file.entries()) {
    if (entry.type != type) continue;
    if (!found.empty()) throw Error("has more than one grid of points; only one is read");
    found = entry.uniqueName;
  }
  if (found.empty()) throw Error("has no grid of points");
  return found;
}

bool holds(const Leaf& leaf, const char* name, const std::string& type) {
  const auto& descriptor = leaf.attributeSet().descriptor();
  const std::size_t at = descriptor.find(name);
  return at != openvdb::points::AttributeSet::INVALID_POS && descriptor.valueType(at) == type;
}

void addLeaf(const Leaf& leaf, const openvdb::math::Transform& transform, PointCloud& cloud) {
  const bool normals = holds(leaf, "N", "vec3s"), colours = holds(leaf, "Cd", "vec3s");
  const AttributeHandle<openvdb::Vec3f> place(leaf.constAttributeArray("P"));
  const auto open = [&leaf](bool there, const char* name) {
    return there ? AttributeHandle<openvdb::Vec3f>::create(leaf.constAttributeArray(name)) : nullptr;
  };
  const auto normal = open(normals, "N"), colour = open(colours, "Cd");
  for (auto index = leaf.beginIndexAll(); index; ++index) {
    const openvdb::Vec3d inVoxel(place.get(*index));
    const openvdb::Vec3d p = transform.indexToWorld(inVoxel + index.getCoord().asVec3d());
    cloud.positions.push_back({p.x(), p.y(), p.z()});
    if (normal) {
      const openvdb::Vec3f n = normal->get(*index);
      cloud.normals.push_back({n.x(), n.y(), n.z()});
    }
    if (colour) {
      const openvdb::Vec3f c = colour->get(*index);
      const auto byte = [](float share) {
        return static_cast<std::uint8_t>(std::lround(255 * (share > 0 ? std::min(share, 1.0F) : 0)));
      };
      cloud.colours.push_back({byte(c.x()), byte(c.y()), byte(c.z())});
    }
  }
}

}  // namespace

PointCloud readVdbPoints(const std::filesystem::path& path) {
  openvdb::initialize();
  const std::string name = findGrid(path);
  openvdb::io::File file(path.string());
  file.open(false);
  const auto grid = openvdb::gridPtrCast<PointDataGrid>(file.readGrid(name));
  PointCloud cloud;
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf)
    if (holds(*leaf, "P", "vec3s")) addLeaf(*leaf, grid->transform(), cloud);
  return cloud;
}

}  // namespace pdc::detail
