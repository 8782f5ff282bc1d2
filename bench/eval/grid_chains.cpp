#include "eval/grid_chains.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <random>

#include "extract/contour_memory.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/extract/contour_forecast.h"
#include "pdc/grid/grid_steps.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc::eval {
namespace {

using openvdb::Coord;
using openvdb::Mat4d;

class Chain {
 public:
  explicit Chain(unsigned seed) : mRandom(seed) {}

  ChainOutcome run() {
    mUnit = pick({1.0, 0.1, 0.1, 1e-4, 1e3});
    try {
      process();
    } catch (const Error& error) {
      mOutcome.refusal = error.what();
      if (mOutcome.refusal.empty() || mOutcome.refusal.find('\n') != std::string::npos)
        mOutcome.fault = "an error that is no line";
    } catch (const std::exception& error) {
      mOutcome.fault = fmt::format("another exception: {}", error.what());
    }
    return mOutcome;
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(mRandom); }
  int dice(int sides) { return std::uniform_int_distribution<>(0, sides - 1)(mRandom); }
  bool one(int in) { return dice(in) == 0; }
  template <typename Value>
  Value pick(std::initializer_list<Value> values) {
    return *(values.begin() + dice(static_cast<int>(values.size())));
  }
  void note(const std::string& text) { mOutcome.what += (mOutcome.what.empty() ? "" : ", ") + text; }

  template <typename GridT>
  openvdb::GridBase::Ptr makeGrid() {
    using Value = typename GridT::ValueType;
    const int kind = dice(5);
    auto grid = GridT::create(static_cast<Value>(kind == 1 ? 0 : 3));
    auto accessor = grid->getAccessor();
    const double radius = uniform(2, 9), width = pick({3.0, 3.0, 1.0, 0.5, 6.0, 30.0});
    const openvdb::Vec3d center(uniform(-2, 2), uniform(-2, 2), uniform(-2, 2));
    note(fmt::format("grid {}", kind));
    for (const Coord& c : openvdb::CoordBBox(Coord(-11), Coord(11))) {
      const double d = (c.asVec3d() - center).length() - radius;
      if (kind == 0 && std::abs(d) < width) accessor.setValue(c, static_cast<Value>(d));
      if (kind == 0 && d <= -width) accessor.setValueOff(c, static_cast<Value>(-width));
      if (kind == 1 && d < 2) accessor.setValue(c, static_cast<Value>(std::clamp(0.5 - d / 4, 0.0, 1.0)));
      if (kind == 2 && one(3)) accessor.setValue(c, static_cast<Value>(uniform(-2, 2)));
      if (kind == 3) accessor.setValue(c, static_cast<Value>(std::sin(0.6 * c.x()) + std::sin(0.6 * c.y() + c.z())));
    }
    if (kind == 0) grid->tree().root().setBackground(static_cast<Value>(width), true);
    if (kind == 0 && mUnit != 1 && !one(6)) scale(*grid, mUnit);
    damage(*grid);
    grid->setGridClass(
        pick({openvdb::GRID_LEVEL_SET, openvdb::GRID_LEVEL_SET, openvdb::GRID_FOG_VOLUME, openvdb::GRID_UNKNOWN}));
    grid->setTransform(makeTransform());
    return grid;
  }

  template <typename GridT>
  void scale(GridT& grid, double factor) {
    using Value = typename GridT::ValueType;
    for (auto it = grid.beginValueAll(); it; ++it) it.setValue(static_cast<Value>(*it * factor));
    grid.tree().root().setBackground(static_cast<Value>(grid.background() * factor), false);
  }

  template <typename GridT>
  void damage(GridT& grid) {
    using Value = typename GridT::ValueType;
    const int kind = dice(12);
    if (kind < 9) note(fmt::format("damage {}", kind));
    auto& tree = grid.tree();
    const Coord at(dice(16) - 8, dice(16) - 8, dice(16) - 8);
    if (kind == 0) tree.setValue(at, std::numeric_limits<Value>::quiet_NaN());
    if (kind == 1) tree.setValue(at, std::numeric_limits<Value>::infinity());
    if (kind == 2) tree.addTile(1, at, static_cast<Value>(uniform(-3, 3)), one(2));
    if (kind == 3) tree.addTile(2, Coord(128 * dice(3), 0, 0), static_cast<Value>(uniform(-1, 1)), one(2));
    mLarge = mLarge || kind == 3;
    if (kind == 4) scale(grid, pick({-1.0, 0.0, 1e-30, 1e30, 0.01}));
    if (kind == 5)
      for (auto it = grid.beginValueOff(); it; ++it) it.setValue(grid.background());
    if (kind == 6) tree.root().setBackground(static_cast<Value>(pick({-3.0, 0.0, 1e20})), one(2));
    if (kind == 7) tree.setValue(Coord(1 << pick({12, 20, 28}), 0, 0), static_cast<Value>(uniform(-1, 1)));
    if (kind == 8)
      for (auto it = grid.beginValueOn(); it; ++it)
        if (one(4)) it.setValueOff();
  }

  openvdb::math::Transform::Ptr makeTransform() {
    const int kind = dice(9);
    if (kind > 0) note(fmt::format("transform {}", kind));
    Mat4d m = Mat4d::identity();
    if (kind == 1) m.preRotate(openvdb::math::Y_AXIS, 0.7);
    if (kind == 2) m.preScale(openvdb::Vec3d(-1, 1, 1));
    if (kind == 3) m.preScale(openvdb::Vec3d(1, 2, 0.3));
    if (kind == 4) m.preShear(openvdb::math::X_AXIS, openvdb::math::Y_AXIS, 0.5);
    if (kind == 5) m.postTranslate(openvdb::Vec3d(1e7, 0, -1e5));
    // OpenVDB takes determinants of 1e-15 for zero.
    if (kind == 6) m.preScale(openvdb::Vec3d(1, 1, mUnit < 1e-3 ? 0.1 : 1e-3));
    if (kind == 7)
      return openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd(openvdb::Vec3d(-12), openvdb::Vec3d(12)),
                                                              0.6, 10 * mUnit, mUnit);
    m.postScale(openvdb::Vec3d(mUnit));
    return openvdb::math::Transform::createLinearTransform(m);
  }

  openvdb::GridBase::Ptr anyGrid() { return one(4) ? makeGrid<openvdb::DoubleGrid>() : makeGrid<openvdb::FloatGrid>(); }

  double length() {
    const double voxels = pick({0.5, 1.0, 2.0, 3.3, 12.0, 1e-6, 1e9});
    // Large tiles that are resampled become voxels.
    return mUnit * (mLarge && voxels > 0.1 ? std::max(voxels, 2.0) : voxels);
  }
  /// Moves take long: they go half a voxel at a time.
  double distance() {
    const double most = mLarge ? 0.5 : 3.3;
    const double voxels = pick({0.3, 1.0, 2.0, 3.3, 1e-6, 1e9});
    return mUnit * (voxels < 10 ? std::min(voxels, most) : voxels);
  }

  GridSteps makeSteps() {
    GridSteps steps;
    const auto wanted = [&](const char* name) {
      if (!one(3)) return false;
      note(name);
      ++mOutcome.steps;
      return true;
    };
    if (wanted("fog")) steps.fogToLevelSet = pick({0.5, 0.1, 0.0, -7.0});
    if (wanted("clip")) {
      const double a = mUnit * uniform(-12, 8), b = mUnit * pick({0.01, 3.0, 9.0, 1e9});
      steps.clip = ClipOptions{.box = {{a, a, -9 * mUnit}, {a + b, a + 20 * mUnit, a + 30 * mUnit}}, .closed = !one(3)};
      if (one(4)) steps.clip->mask = anyGrid();
    }
    if (wanted("resample"))
      steps.resample = ResampleOptions{.voxelSize = length(),
                                       .method = pick({ResampleMethod::kBest, ResampleMethod::kBest,
                                                       ResampleMethod::kTrilinear, ResampleMethod::kQuadratic})};
    if (wanted("smooth"))
      steps.smooth = SmoothGridOptions{.filter = pick({SmoothFilter::kMean, SmoothFilter::kGaussian,
                                                       SmoothFilter::kMedian, SmoothFilter::kCurvature}),
                                       .radius = length()};
    if (wanted("offset")) steps.offset = distance() * pick({-1, 1});
    if (wanted("open-close")) steps.openClose = distance();
    if (wanted("combine"))
      steps.combine.push_back({.kind = pick({CombineKind::kUnion, CombineKind::kIntersect, CombineKind::kSubtract}),
                               .other = settleGrid(anyGrid(), {.acceptNonFinite = true}),
                               .name = "other"});
    if (wanted("keep")) steps.keep = one(2) ? KeepOptions{.most = 1} : KeepOptions{.moreVoxelsThan = 20};
    if (wanted("fill")) steps.fillCavities = true;
    return steps;
  }

  void process() {
    SettleOptions settle{.acceptNonFinite = !one(4)};
    if (one(4)) settle.meaning.gridClass = pick({GridClass::kLevelSet, GridClass::kFogVolume});
    if (one(8)) settle.meaning.inside = pick({InsideValues::kLow, InsideValues::kHigh});
    if (one(8)) settle.meaning.floodFill = true;
    if (one(6)) settle.meaning.iso = uniform(-1, 1);
    GridVolume volume = settleGrid(anyGrid(), settle);
    applyGridSteps(volume, makeSteps());
    const GridSource source(volume.grid, {.iso = volume.iso, .gridClass = volume.gridClass, .inside = volume.inside});
    // Between tiles of thousands of voxels there can be surfaces of a hundred million vertices, which take minutes, and
    // finding their blocks takes seconds: as `pdc mesh` does, ask first.
    const ContourOptions options{.maxMemory = std::size_t{1} << 30};
    if (const auto forecast = forecastContour(source, options))
      detail::checkMemory(forecast->memory, forecast->vertices, options);
    const MeshReport report = analyze(contour(source, options));
    if (report.boundaryEdges + report.nonManifoldEdges + report.misorientedEdges > 0)
      mOutcome.fault = "a mesh that is open or no manifold";
  }

  std::mt19937 mRandom;
  double mUnit = 1;
  bool mLarge = false;  ///< Whether a grid has a tile of 128 voxels.
  ChainOutcome mOutcome;
};

}  // namespace

ChainOutcome runRandomChain(unsigned seed) {
  openvdb::initialize();
  return Chain(seed).run();
}

}  // namespace pdc::eval
