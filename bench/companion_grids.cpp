// Writes a grid file with a torus, "surface", and grids of other transforms that say something of its places: "scale",
// small on one side; "temperature"; "velocity" and "Cd", vectors, a colour in the latter.
// usage: companion_grids OUT.vdb

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <exception>

#include "eval/inputs.h"

namespace {

using openvdb::math::Transform;

constexpr double kRadius = 30, kTube = 12;  // voxels

double torus(const pdc::Vec3d& p) { return std::hypot(std::hypot(p.x, p.y) - kRadius, p.z) - kTube; }

/// A grid with voxels of an edge, turned about z, that holds value(place) wherever the torus may be.
template <typename Grid, typename Value>
typename Grid::Ptr grid(const char* name, double edge, double turn, const Value& value) {
  auto grid = Grid::create();
  grid->setName(name);
  auto transform = Transform::createLinearTransform(edge);
  transform->postRotate(turn, openvdb::math::Z_AXIS);
  grid->setTransform(transform);
  const int reach = static_cast<int>(1.5 * (kRadius + kTube + 4) / edge);
  auto accessor = grid->getAccessor();
  for (openvdb::Coord c(-reach); c.x() <= reach; ++c.x())
    for (c.y() = -reach; c.y() <= reach; ++c.y())
      for (c.z() = -reach / 2; c.z() <= reach / 2; ++c.z()) accessor.setValue(c, value(transform->indexToWorld(c)));
  return grid;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: companion_grids OUT.vdb\n");
    return 2;
  }
  openvdb::initialize();
  try {
    const auto surface = pdc::eval::makeClean("level_set", torus, kRadius + kTube).grid;
    surface->setName("surface");
    const auto scale = grid<openvdb::FloatGrid>("scale", 3, 0.3, [](const openvdb::Vec3d& p) {
      const double share = p.x() / (2 * kRadius) + 0.5;
      return static_cast<float>(std::pow(10.0, 2 * std::clamp(share, 0.0, 1.0) - 2));
    });
    const auto temperature = grid<openvdb::FloatGrid>("temperature", 2, 0.7, [](const openvdb::Vec3d& p) {
      return static_cast<float>(300 + 40 * std::sin(0.15 * p.x()) * std::cos(0.15 * p.y()));
    });
    const auto velocity = grid<openvdb::Vec3SGrid>(
        "velocity", 2.5, 0, [](const openvdb::Vec3d& p) { return openvdb::Vec3s(openvdb::Vec3d(-p.y(), p.x(), 0)); });
    const auto colour = grid<openvdb::Vec3SGrid>("Cd", 1.7, 1.1, [](const openvdb::Vec3d& p) {
      return openvdb::Vec3s(openvdb::Vec3d(0.5) + p * (0.5 / (kRadius + kTube)));
    });
    openvdb::io::File file(argv[1]);
    file.write(openvdb::GridCPtrVec{surface, scale, temperature, velocity, colour});
    file.close();
  } catch (const std::exception& e) {
    fmt::print(stderr, "companion_grids: {}\n", e.what());
    return 1;
  }
}
