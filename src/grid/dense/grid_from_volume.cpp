#include "pdc/grid/grid_from_volume.h"

#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sample/dense/check_volume.h"
#include "sample/dense/stored_scalars.h"

namespace pdc {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

template <typename Scalar>
std::unique_ptr<Leaf> leafAt(const VolumeView& volume, const openvdb::Coord& origin, float background) {
  auto leaf = std::make_unique<Leaf>(origin, background, false);
  constexpr int kDim = Leaf::DIM;
  openvdb::Coord end;
  for (int axis = 0; axis < 3; ++axis)
    end[axis] =
        static_cast<int>(std::min<std::int64_t>(kDim, volume.size[static_cast<std::size_t>(axis)] - origin[axis]));
  for (int x = 0; x < end.x(); ++x)
    for (int y = 0; y < end.y(); ++y) {
      const detail::StoredLine<typename Scalar::Raw> line{volume.data + volume.stride[0] * (origin.x() + x) +
                                                              volume.stride[1] * (origin.y() + y) +
                                                              volume.stride[2] * origin.z(),
                                                          volume.stride[2], volume.swapped};
      for (int z = 0; z < end.z(); ++z) {
        const double value = volume.slope * static_cast<double>(Scalar::number(line[z])) + volume.intercept;
        leaf->setValueOn(Leaf::coordToOffset({x, y, z}), static_cast<float>(value));
      }
    }
  return leaf;
}

}  // namespace

openvdb::FloatGrid::Ptr gridFromVolume(const VolumeView& volume, const Mat3d& linear, const Vec3d& translation,
                                       float background, const Monitor& monitor) {
  detail::checkVolume(volume, "the volume");
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(background);
  openvdb::Mat4R matrix = openvdb::Mat4R::identity();  // It acts on rows from the right.
  for (int axis = 0; axis < 3; ++axis) {
    for (int row = 0; row < 3; ++row) matrix(axis, row) = linear.row[static_cast<std::size_t>(row)][axis];
    matrix(3, axis) = translation[axis];
  }
  grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));

  constexpr int kDim = Leaf::DIM;
  std::array<int, 3> last;
  for (std::size_t axis = 0; axis < 3; ++axis) last[axis] = static_cast<int>(volume.size[axis] - 1);
  for (int x = 0; x <= last[0]; x += kDim) {
    monitor.throwIfStopped();
    if (monitor.progress) monitor.progress("reading", static_cast<double>(x) / last[0]);
    std::vector<openvdb::Coord> origins;
    for (int y = 0; y <= last[1]; y += kDim)
      for (int z = 0; z <= last[2]; z += kDim) origins.emplace_back(x, y, z);
    std::vector<std::unique_ptr<Leaf>> leaves(origins.size());
    tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t i) {
      leaves[i] = detail::visitScalar(
          volume.type, [&](auto scalar) { return leafAt<decltype(scalar)>(volume, origins[i], background); });
    });
    for (auto& leaf : leaves) grid->tree().addLeaf(leaf.release());
  }
  return grid;
}

}  // namespace pdc
