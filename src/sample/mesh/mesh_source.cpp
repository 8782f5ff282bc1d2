#include "pdc/sample/mesh/mesh_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "pdc/error.h"
#include "pdc/math/box.h"
#include "pdc/sample/implicit/field_source.h"
#include "sample/mesh/mesh_solid.h"

namespace pdc {
namespace {

constexpr double kMargin = 1.5;                     // voxels
constexpr double kSmallestRelativeVoxel = 0x1p-32;  // As for a FieldSource.

Box boxOf(const detail::ClosedSurface& surface) {
  Box box = Box::empty();
  for (std::size_t i = 0; i < surface.own; ++i)
    for (const Vec3d& p : surface.points(i)) box.include(p);
  return box;
}

detail::MeshLattice makeLattice(const detail::ClosedSurface& surface, double h) {
  if (!(h > 0) || !std::isfinite(h)) throw Error(fmt::format("voxel size must be positive and finite, not {}", h));
  if (surface.own == 0) throw Error("the mesh has no triangle with finite corners");
  const Box box = boxOf(surface);
  const double smallest = kSmallestRelativeVoxel * std::max(largestEntry(box), largestEntry(surface.surface.origin));
  if (h < smallest)
    throw Error(fmt::format("voxel size must be at least {} at these coordinates, not {}", smallest, h));
  for (int axis = 0; axis < 3; ++axis)
    if (const double cells = (box.hi[axis] - box.lo[axis]) / h; !(cells <= kMaxVoxelsPerAxis))
      throw Error(fmt::format("voxels per axis must be at most {}, not {:.0f} along {}", kMaxVoxelsPerAxis, cells,
                              "xyz"[axis]));
  return {box.lo - Vec3d{h, h, h} * kMargin, h};
}

/// How many lattice edges pass through the triangles, but for rounding.
double crossingsOf(const detail::ClosedSurface& surface, std::size_t triangles, double voxelSize) {
  double sum = 0;
  for (std::size_t i = 0; i < triangles; ++i) {
    const std::array<Vec3d, 3> t = surface.points(i);
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    sum += (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) / 2;
  }
  return sum / (voxelSize * voxelSize);
}

}  // namespace

struct MeshSource::Impl {
  Impl(const Mesh& mesh, const MeshSourceOptions& options, const Monitor& monitor)
      : surface(detail::closeSurface(mesh, monitor)),
        lattice(makeLattice(surface, options.voxelSize)),
        map(Mat3d::diagonal(lattice.voxelSize, lattice.voxelSize, lattice.voxelSize), mesh.origin + lattice.origin),
        facts{.triangles = surface.own, .openEdges = surface.surface.triangles.size() - surface.own} {}

  /// Makes it when it is first asked for: a forecast should not take its memory.
  const detail::MeshSolid& solidOf(const Monitor& monitor) {
    std::call_once(made, [&] { solid.emplace(surface, lattice, monitor); });
    return *solid;
  }

  detail::ClosedSurface surface;
  detail::MeshLattice lattice;
  LatticeMap map;
  MeshSourceFacts facts;
  std::once_flag made;
  std::optional<detail::MeshSolid> solid;
};

MeshSource::MeshSource(const Mesh& mesh, const MeshSourceOptions& options, const Monitor& monitor)
    : mImpl(std::make_unique<Impl>(mesh, options, monitor)) {}

MeshSource::~MeshSource() = default;

SurfaceBlocks MeshSource::surfaceBlocks(const Monitor& monitor) const {
  return mImpl->solidOf(monitor).surfaceBlocks(monitor);
}

std::optional<SurfaceForecast> MeshSource::forecast(const Monitor& /*monitor*/) const {
  constexpr double kCrossingsPerBlock = 100;  // A plane along an axis has 81.
  constexpr double kCopies = 2;               // While they are gathered.
  const double crossings = crossingsOf(mImpl->surface, mImpl->surface.own, mImpl->lattice.voxelSize);
  const double all = crossingsOf(mImpl->surface, mImpl->surface.surface.triangles.size(), mImpl->lattice.voxelSize);
  return SurfaceForecast{.blocks = crossings / kCrossingsPerBlock,
                         .crossings = crossings,
                         .memory = kCopies * sizeof(detail::EdgeCrossing) * all};
}

const LatticeMap& MeshSource::map() const { return mImpl->map; }

void MeshSource::fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const {
  const detail::MeshSolid& solid = mImpl->solidOf({});
  block.edges.forEach([&](int i, Axis axis, int x, int y, int z) {
    const Coord point{kBlockSize * block.coord[0] + x, kBlockSize * block.coord[1] + y,
                      kBlockSize * block.coord[2] + z};
    const auto [t, normal] = solid.crossing(axis, point, block.signs.inside(x, y, z));
    const auto n = static_cast<std::size_t>(i);
    hermite.t[n] = t;
    hermite.nx[n] = normal.x;
    hermite.ny[n] = normal.y;
    hermite.nz[n] = normal.z;
  });
}

const MeshSourceFacts& MeshSource::facts() const { return mImpl->facts; }

}  // namespace pdc
