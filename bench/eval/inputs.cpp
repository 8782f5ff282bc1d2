#include "eval/inputs.h"

#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pdc::eval {
namespace {

constexpr float kHalfWidth = 3;

/// A level set. \param reach of the solid from the origin, in voxels.
openvdb::FloatGrid::Ptr sampleDistance(const std::function<double(const Vec3d&)>& distance, double reach) {
  auto grid = openvdb::FloatGrid::create(kHalfWidth);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  const auto value = [&](const openvdb::Vec3d& p) { return distance({p.x(), p.y(), p.z()}); };
  const int blocks = (static_cast<int>(reach) + 8) / 8 + 1;
  const openvdb::CoordBBox box(openvdb::Coord(-blocks), openvdb::Coord(blocks));
  for (auto it = box.beginXYZ(); it; ++it) {
    const openvdb::Coord origin((*it).x() * 8, (*it).y() * 8, (*it).z() * 8);
    constexpr double kToCorner = 6.1;  // A leaf's points lie within this distance of their middle.
    if (std::abs(value(origin.asVec3d() + openvdb::Vec3d(3.5))) > kHalfWidth + kToCorner) continue;
    auto* leaf = grid->tree().touchLeaf(origin);
    for (openvdb::Index i = 0; i < 512; ++i) {
      const double d = value(leaf->offsetToGlobalCoord(i).asVec3d());
      if (std::abs(d) < kHalfWidth) {
        leaf->setValueOn(i, static_cast<float>(d));
      } else {
        leaf->setValueOff(i, d < 0 ? -kHalfWidth : kHalfWidth);
      }
    }
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

openvdb::FloatGrid::Ptr rasterise(const Shape& shape, const Pose& pose) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  for (const Vec3d& p : shape.mesh.points) {
    const Vec3d w = pose.toWorld(p);
    points.emplace_back(w.x, w.y, w.z);
  }
  for (const auto& t : shape.mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*openvdb::math::Transform::createLinearTransform(1.0),
                                                            points, triangles, kHalfWidth);
}

}  // namespace

const std::vector<std::string>& gridInputs() {
  static const std::vector<std::string> all{"exact", "half", "iso", "mesh"};
  return all;
}

GridInput makeGrid(const std::string& input, const Shape& shape, const Pose& pose, double noise, unsigned seed) {
  const double iso = input == "iso" ? 1 : 0;
  const auto distance = [&](const Vec3d& p) { return shape.distance(pose.toShape(p)) * pose.size + iso; };
  // All solids lie within twice their half size.
  const GridInput clean{input == "mesh" ? rasterise(shape, pose) : sampleDistance(distance, 2 * pose.size), iso};
  return withNoise(clean, noise, input == "half", seed);
}

GridInput makeClean(const std::string& input, const std::function<double(const Vec3d&)>& distance, double reach) {
  GridInput out{sampleDistance(distance, reach), 0};
  if (input == "level_set") return out;
  out.iso = 0.5;
  auto fog = openvdb::FloatGrid::create(0);
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  fog->tree().topologyUnion(out.grid->tree());
  const auto accessor = out.grid->getConstAccessor();
  const auto density = [](float d) { return std::clamp(0.5F - d / kHalfWidth, 0.0F, 1.0F); };
  for (auto it = fog->beginValueOn(); it; ++it) it.setValue(density(accessor.getValue(it.getCoord())));
  // What lies deeper inside than the band is full.
  for (auto it = out.grid->cbeginValueOff(); it; ++it)
    if (*it < 0) fog->tree().fill(it.getBoundingBox(), 1, true);
  out.grid = fog;
  return out;
}

GridInput withNoise(const GridInput& clean, double noise, bool half, unsigned seed) {
  GridInput out{clean.grid->deepCopy(), clean.iso};
  const bool fog = clean.grid->getGridClass() == openvdb::GRID_FOG_VOLUME;
  const double perVoxel = fog ? 1.0 / double{kHalfWidth} : 1.0;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (auto it = out.grid->beginValueOn(); it; ++it) {
    if (!it.isVoxelValue()) continue;
    float v = *it;
    if (noise > 0) v += static_cast<float>(noise * perVoxel * normal(random));
    if (half) v = static_cast<float>(openvdb::math::half(v));
    it.setValue(v);
  }
  return out;
}

GridInput makeGradedGrid(const Shape& shape, const Pose& pose, double noise, unsigned seed) {
  GridInput out = makeGrid("exact", shape, pose, 0, seed);
  out.sigma = openvdb::FloatGrid::create(static_cast<float>(noise));
  out.sigma->setTransform(out.grid->transformPtr());
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto box = out.grid->evalActiveVoxelBoundingBox();
  const double low = box.min().x(), high = box.max().x();
  auto accessor = out.sigma->getAccessor();
  for (auto it = out.grid->beginValueOn(); it; ++it) {
    const double sigma = noise * (it.getCoord().x() - low) / (high - low);
    it.setValue(*it + static_cast<float>(sigma * normal(random)));
    accessor.setValue(it.getCoord(), static_cast<float>(sigma));
  }
  return out;
}

}  // namespace pdc::eval
