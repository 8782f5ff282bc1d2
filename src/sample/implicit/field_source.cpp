#include "pdc/sample/implicit/field_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include "pdc/error.h"
#include "sample/implicit/block_forecast.h"
#include "sample/implicit/block_search.h"
#include "sample/implicit/capped_field.h"
#include "sample/implicit/cube_descent.h"
#include "sample/implicit/edge_roots.h"
#include "sample/implicit/missing_points.h"
#include "sample/implicit/root_normals.h"
#include "sample/implicit/simplified_fields.h"

namespace pdc {
namespace {

// So that a crossing can be told from its neighbours 2^-20 of an edge away in double precision.
constexpr double kSmallestRelativeVoxel = 0x1p-32;

void check(const FieldSourceOptions& options) {
  const double h = options.voxelSize;
  if (!(h > 0) || !std::isfinite(h)) throw Error(fmt::format("voxel size must be positive and finite, not {}", h));
  if (!std::isfinite(options.iso)) throw Error(fmt::format("iso value must be finite, not {}", options.iso));
  for (int axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    const double lo = options.box.lo[axis], hi = options.box.hi[axis];
    if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo < hi))
      throw Error(fmt::format("box must be finite and not empty, not go from {} to {} along {}", lo, hi, name));
    if (const double cells = (hi - lo) / h; !(cells <= kMaxVoxelsPerAxis))
      throw Error(
          fmt::format("voxels per axis must be at most {}, not {:.0f} along {}", kMaxVoxelsPerAxis, cells, name));
    const double smallest = kSmallestRelativeVoxel * std::max(std::abs(lo), std::abs(hi));
    if (h < smallest)
      throw Error(fmt::format("voxel size must be at least {} at these coordinates, not {}", smallest, h));
  }
}

Coord cellCounts(const FieldSourceOptions& options) {
  Coord n;
  for (int axis = 0; axis < 3; ++axis)
    n[axis] = static_cast<int>(voxelsAlong(options.box.hi[axis] - options.box.lo[axis], options.voxelSize));
  return n;
}

detail::LatticeFrame frameOf(const FieldSourceOptions& options) { return {options.box.lo, options.voxelSize}; }

/// The function whose zero set is contoured. The box is pulled in to the last lattice point if it exceeds it by a hair:
/// then everything on and beyond the lattice's limits is outside, and no cell beyond them can hold surface.
FieldPtr makeLevelField(FieldPtr field, const FieldSourceOptions& options) {
  if (!field) throw std::invalid_argument("FieldSource: field is null");
  check(options);
  if (options.open) return std::make_shared<detail::CappedField>(std::move(field), options.iso);
  const Coord cells = cellCounts(options);
  Box cap = options.box;
  for (int axis = 0; axis < 3; ++axis) cap.hi[axis] = std::min(cap.hi[axis], frameOf(options).at(axis, cells[axis]));
  return std::make_shared<detail::CappedField>(std::move(field), options.iso, cap);
}

detail::BlockSearch searchOf(const detail::SimplifiedFields& fields, const FieldSourceOptions& options,
                             detail::MissingPoints* missing) {
  return {fields, frameOf(options), cellCounts(options), options.open, missing};
}

}  // namespace

long long voxelsAlong(double side, double voxelSize) {
  constexpr double kHair = 1e-9;  // voxels
  return std::max(1LL, static_cast<long long>(std::ceil(side / voxelSize - kHair)));
}

FieldSource::FieldSource(FieldPtr field, const FieldSourceOptions& options)
    : mFunction(field),
      mField(makeLevelField(std::move(field), options)),
      mOptions(options),
      mFields(std::make_shared<detail::SimplifiedFields>(mField, frameOf(options),
                                                         detail::blockCounts(cellCounts(options)))),
      mMap(Mat3d::diagonal(options.voxelSize, options.voxelSize, options.voxelSize), options.box.lo) {}

SurfaceBlocks FieldSource::surfaceBlocks(const Monitor& monitor) const {
  detail::MissingPoints missing(*mFunction, frameOf(mOptions), cellCounts(mOptions));
  return detail::findSurfaceBlocks(searchOf(*mFields, mOptions, mOptions.acceptNonFinite ? nullptr : &missing),
                                   monitor);
}

std::optional<SurfaceForecast> FieldSource::forecast(const Monitor& monitor) const {
  return detail::forecastSurfaceBlocks(searchOf(*mFields, mOptions, nullptr), monitor);
}

void FieldSource::fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const {
  const detail::LatticeFrame frame = frameOf(mOptions);
  const detail::LocalField field = mFields->in(block.coord, 0);
  detail::EdgeBatch batch;
  std::array<double, detail::EdgeBatch::kCapacity> t;
  std::size_t done = 0;
  const auto flush = [&] {
    detail::findEdgeRoots(*field, frame, batch, t.data());
    detail::findRootNormals(*field, frame, batch, t.data(), hermite, done);
    for (std::size_t i = 0; i < batch.size; ++i) hermite.t[done + i] = static_cast<float>(t[i]);
    done += batch.size;
    batch.size = 0;
  };
  block.edges.forEach([&](int, int axis, int x, int y, int z) {
    const std::array<int, 3> local{x, y, z};
    for (int a = 0; a < 3; ++a) batch.low[a][batch.size] = kBlockSize * block.coord[a] + local[a];
    batch.axis[batch.size] = static_cast<std::uint8_t>(axis);
    if (++batch.size == detail::EdgeBatch::kCapacity) flush();
  });
  if (batch.size > 0) flush();
}

}  // namespace pdc
