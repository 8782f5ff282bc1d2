#include "pdc/field/grid_field.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "field/arguments.h"
#include "field/boundary.h"
#include "field/finite_voxels.h"
#include "field/image_box.h"
#include "field/interval_arithmetic.h"
#include "field/trilinear_cell.h"
#include "field/voxel_ranges.h"
#include "pdc/error.h"
#include "pdc/math/mat3.h"

namespace pdc {
namespace {

using detail::TrilinearCell;
using openvdb::Coord;

/// The map from world space to index space, p ↦ linear · (p - origin).
struct ToIndex {
  Mat3d linear;
  Vec3d origin;
};

ToIndex toIndex(const openvdb::GridBase& grid) {
  if (!grid.transform().isLinear())
    throw Error(fmt::format("grid \"{}\": transform of type {}, expected an affine one", grid.getName(),
                            grid.transform().mapType()));
  // OpenVDB multiplies row vectors from the left, so its rows are columns here.
  const openvdb::Mat4d m = grid.transform().baseMap()->getAffineMap()->getMat4();
  Mat3d toWorld;
  for (int i = 0; i < 3; ++i) toWorld.row[i] = {m(0, i), m(1, i), m(2, i)};
  const Mat3d linear = inverse(toWorld);
  for (const Vec3d& row : linear.row)
    if (!std::isfinite(length(row)))
      throw Error(fmt::format("grid \"{}\": transform with determinant {}, expected one that can be inverted",
                              grid.getName(), toWorld.determinant()));
  return {linear, {m(3, 0), m(3, 1), m(3, 2)}};
}

/// Index coordinates are cut off beyond this, where no grid reaches, so that int has room for them and their
/// differences.
constexpr double kFarthest = 1 << 29;

/// The largest integer not above x; the comparisons are such that NaN becomes an int too.
int indexFloor(double x) {
  const double inside = x > -kFarthest ? (x < kFarthest ? x : kFarthest) : -kFarthest;
  const int towardsZero = static_cast<int>(inside);
  return towardsZero - (inside < towardsZero ? 1 : 0);
}

Coord indexFloor(const Vec3d& p) { return {indexFloor(p.x), indexFloor(p.y), indexFloor(p.z)}; }

template <typename Grid>
class GridField final : public Field {
 public:
  GridField(typename Grid::ConstPtr grid, double iso, bool insideIsHigher, bool finite)
      : mGrid(std::move(grid)),
        mToIndex(toIndex(*mGrid)),
        mIso(iso),
        mSign(insideIsHigher ? -1 : 1),
        mFinite(finite),
        mRanges(mGrid->tree()) {}

  void values(PointSpan points, double* values) const override {
    const Accessor accessor(mGrid->tree());
    for (std::size_t i = 0; i < points.size; ++i)
      values[i] = value(cellAt({points.x[i], points.y[i], points.z[i]}, accessor));
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    const Accessor accessor(mGrid->tree());
    const Mat3d pullBack = mToIndex.linear.transposed() * mSign;
    for (std::size_t i = 0; i < points.size; ++i) {
      const TrilinearCell cell = cellAt({points.x[i], points.y[i], points.z[i]}, accessor);
      const Vec3d g = pullBack * cell.gradient();
      values[i] = value(cell);
      gradients.x[i] = g.x;
      gradients.y[i] = g.y;
      gradients.z[i] = g.z;
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    const Box local = detail::imageBox(mToIndex.linear, mToIndex.origin, box);
    const Coord first = indexFloor(local.lo), last = indexFloor(local.hi).offsetBy(1);
    bool few = true;
    for (int i = 0; i < 3; ++i) few = few && last[i] - first[i] < kScanVoxels;
    const Interval voxels = few ? scan(local, first, last) : mRanges.range(first, last);
    if (!(voxels.lo <= voxels.hi)) return Interval::whole();
    const Interval range = detail::widened(voxels, std::abs(mIso)) + -mIso;
    return mSign < 0 ? -range : range;
  }

  [[nodiscard]] bool definedIn(const Box& box) const override {
    if (!mFinite || !(largestEntry(box) < detail::kUsual)) return false;
    const Interval range = bound(box);
    return range.lo > -detail::kUsual && range.hi < detail::kUsual;
  }

 private:
  using Accessor = openvdb::tree::ValueAccessor<const typename Grid::TreeType, false>;

  /// As many voxels per axis as a box of 8³ cells touches, wherever it lies on the lattice.
  static constexpr int kScanVoxels = 10;

  [[nodiscard]] double value(const TrilinearCell& cell) const {
    const double v = cell.value();
    return std::isfinite(v) ? detail::open(mSign * (v - mIso)) : std::numeric_limits<double>::quiet_NaN();
  }

  [[nodiscard]] TrilinearCell cellAt(const Vec3d& world, const Accessor& accessor) const {
    const Vec3d p = mToIndex.linear * (world - mToIndex.origin);
    const Coord lower = indexFloor(p);
    TrilinearCell cell;
    cell.t = {p.x - lower.x(), p.y - lower.y(), p.z - lower.z()};
    detail::readVoxels(accessor, lower, cell);
    return cell;
  }

  /// The exact range over a small index box. The interpolant is linear along each axis from one lattice plane, or face
  /// of the box, to the next; so the outermost voxels are moved onto the faces, and then no value lies beyond those.
  [[nodiscard]] Interval scan(const Box& box, const Coord& first, const Coord& last) const {
    constexpr int kStride[3] = {kScanVoxels * kScanVoxels, kScanVoxels, 1};
    const int size[3] = {last.x() - first.x() + 1, last.y() - first.y() + 1, last.z() - first.z() + 1};
    double v[kScanVoxels * kScanVoxels * kScanVoxels];
    const Accessor accessor(mGrid->tree());
    for (int x = 0; x < size[0]; ++x)
      for (int y = 0; y < size[1]; ++y)
        for (int z = 0; z < size[2]; ++z)
          v[x * kStride[0] + y * kStride[1] + z] = accessor.getValue(first.offsetBy(x, y, z));
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, other = (axis + 2) % 3;
      const double atFirst = box.lo[axis] - first[axis], atLast = box.hi[axis] - (last[axis] - 1);
      for (int i = 0; i < size[next]; ++i)
        for (int j = 0; j < size[other]; ++j) {
          double* line = v + i * kStride[next] + j * kStride[other];
          double* end = line + (size[axis] - 1) * kStride[axis];
          const double onFirst = detail::lerp(line[0], line[kStride[axis]], atFirst);
          *end = detail::lerp(end[-kStride[axis]], *end, atLast);
          *line = onFirst;
        }
    }
    Interval range = detail::kEmptyRange;
    for (int x = 0; x < size[0]; ++x)
      for (int y = 0; y < size[1]; ++y)
        for (int z = 0; z < size[2]; ++z) detail::include(range, v[x * kStride[0] + y * kStride[1] + z]);
    return range;
  }

  typename Grid::ConstPtr mGrid;
  ToIndex mToIndex;
  double mIso, mSign;
  bool mFinite;  ///< Whether all voxels are.
  detail::VoxelRanges<typename Grid::TreeType> mRanges;
};

}  // namespace

FieldPtr gridField(const openvdb::GridBase::ConstPtr& grid, double iso, bool insideIsHigher, bool acceptNonFinite) {
  if (!grid) throw std::invalid_argument("gridField grid must not be null");
  detail::requireFinite("gridField iso", iso);
  const auto make = [&]<typename Grid>(std::shared_ptr<const Grid> typed) -> FieldPtr {
    if (!acceptNonFinite) detail::requireFiniteVoxels(typed->tree());
    return std::make_shared<GridField<Grid>>(std::move(typed), iso, insideIsHigher, !acceptNonFinite);
  };
  if (auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid)) return make(std::move(floats));
  if (auto doubles = openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid)) return make(std::move(doubles));
  throw Error(
      fmt::format("grid \"{}\": values of type {}, expected float or double", grid->getName(), grid->valueType()));
}

}  // namespace pdc
