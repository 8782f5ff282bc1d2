#include "apps/grid_files.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <limits>

namespace pdc::test {
namespace {

void spoil(openvdb::FloatGrid& grid, int nanVoxels, int infiniteVoxels) {
  for (auto voxel = grid.beginValueOn(); voxel && nanVoxels + infiniteVoxels > 0; ++voxel) {
    if (std::abs(*voxel) > grid.voxelSize()[0]) continue;
    const bool nan = nanVoxels > 0;
    voxel.setValue(nan ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity());
    --(nan ? nanVoxels : infiniteVoxels);
  }
}

void turn(openvdb::FloatGrid& grid) {
  const float background = grid.background();
  for (auto value = grid.beginValueAll(); value; ++value) value.setValue(-*value);
  grid.tree().root().setBackground(-background, false);
}

void empty(openvdb::FloatGrid& grid) {
  for (auto value = grid.beginValueOff(); value; ++value) value.setValue(grid.background());
}

openvdb::FloatGrid::Ptr companion(const openvdb::FloatGrid& sphere, const char* name, float low, float high) {
  auto grid = openvdb::FloatGrid::create(0);
  grid->setName(name);
  grid->setTransform(sphere.transform().copy());
  for (auto voxel = sphere.cbeginValueOn(); voxel; ++voxel)
    grid->tree().setValue(voxel.getCoord(), voxel.getCoord().x() > 0 ? high : low);
  return grid;
}

void addNoiseGrids(const openvdb::FloatGrid& sphere, openvdb::GridPtrVec& grids) {
  grids.push_back(companion(sphere, "sigma", 0, 0.02F));
  grids.push_back(companion(sphere, "weight", 1, 1));
  grids.push_back(companion(sphere, "halved", 0, 1));
  grids.push_back(companion(sphere, "faulty", -1, -1));
  grids.push_back(companion(sphere, "moved", 1, 1));
  grids.back()->setTransform(openvdb::math::Transform::createLinearTransform(0.3));
}

void addScaleGrids(openvdb::GridPtrVec& grids) {
  auto scale = openvdb::FloatGrid::create(0.1F);
  scale->setName("scale");
  scale->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  scale->fill(openvdb::CoordBBox({0, -8, -8}, {8, 8, 8}), 1.0F);
  grids.push_back(scale);
  grids.push_back(openvdb::BoolGrid::create());
  grids.back()->setName("mask");
}

}  // namespace

void writeSphere(const std::filesystem::path& path, const SphereFile& content) {
  openvdb::initialize();
  openvdb::GridPtrVec grids;
  if (content.vectorGrid) {
    grids.push_back(openvdb::Vec3SGrid::create());
    grids.back()->setName("velocity");
  } else {
    auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, {0, 0, 0}, 0.1f);
    sphere->setName("sphere");
    sphere->transform().postTranslate({content.offset, 0, 0});
    if (content.positiveInside) turn(*sphere);
    if (!content.floodFilled) empty(*sphere);
    spoil(*sphere, content.nanVoxels, content.infiniteVoxels);
    grids.push_back(sphere);
    if (content.noiseGrids) addNoiseGrids(*sphere, grids);
    if (content.scaleGrids) addScaleGrids(grids);
    if (content.twoGrids) {
      grids.push_back(sphere->deepCopyGrid());
      grids.back()->setName("other");
    }
  }
  openvdb::io::File file(path.string());
  file.write(grids);
  file.close();
}

}  // namespace pdc::test
