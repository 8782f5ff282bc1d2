#include "sample/creases/distance_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "math/lane_loops.h"
#include "sample/cell_edges.h"
#include "sample/creases/crease_sheets.h"
#include "sample/creases/gradient_jumps.h"

namespace pdc::detail {
namespace {

// All constants below were chosen with bench/feature_eval: the tuning shapes at 64³, noise 0, 0.02 and 0.1 voxels.

/// Normals within 2.5° of each other leave no room for a crease. With 5° edges were 4 to 14 % less exact.
constexpr float kEvenCos = 0.999F;
/// Those within 1.255° of one are within 2.51° of each other.
constexpr float kHalfEvenCos = 0.99976F;

PlaneTolerance tolerance(double noise) {
  const auto n = static_cast<float>(noise);
  return {.error = 0.04F + 2 * n, .usual = 0.001F + 2 * n, .jump = 0.005F + n};
}

/// Where slopes from both sides differ by less, at all corners of a cell, no crease turns by more than 20° there, or
/// noise or texture hide it. Plain gradients miss one that turns by 30° by 0.06 voxel. With 100 times the texture
/// vertices of an organic mesh were off by 1.7 times as much as with plain gradients, with 200 times by as much.
float creaseJump(const DistanceModel& model) {
  return static_cast<float>(std::max({0.2, 0.01 + 2 * model.noise, 200 * model.texture}));
}

/// A sheet this far from where all sheets meet, in voxels, does not meet them.
double missed(double noise) { return 0.1 + 2 * noise; }

/// How far outside a cell, in voxels, sheets may meet that no crossing of it lies on. Without noise the crossings are
/// reliable, and vertices that leave their cells for nothing fold faces.
double margin(double noise) { return std::min(0.5, 5 * noise); }

/// σn of sheets: they are made of many samples.
float sheetSigma(double noise) { return static_cast<float>(std::max(0.01, 0.7 * noise)); }

/// Sheets that weigh less than this share of the heaviest are samples that noise has turned aside.
double leastShare(double noise) { return std::min(0.1, 10 * noise * noise); }

/// What is expected of a sample's normal.
double normalNoise(double noise) { return kNormalNoise * noise; }

/// A corner of a cell, from its centre, in lattice units.
Vec3d fromCenter(int corner) { return cornerPlace(corner) - Vec3d{0.5, 0.5, 0.5}; }

/// Whether the normals of all of a block's crossings agree, as most blocks' do. Not all that do are found.
bool allEven(const SampledBlock& block) {
  const HermiteBlock& h = block.hermite;
  const int count = block.edges.size();
  alignas(64) std::array<std::int32_t, kLanes> apart{};
  forEachBatch(bestSimdLevel(), batchCount(static_cast<std::size_t>(count)), [&](std::size_t i) {
    const Vec3f first{h.nx[0], h.ny[0], h.nz[0]};
    const float *nx = &h.nx[i * kLanes], *ny = &h.ny[i * kLanes], *nz = &h.nz[i * kLanes];
    const int left = count - static_cast<int>(i) * kLanes;
    forEachLane([&](int lane) {
      const bool near = first.x * nx[lane] + first.y * ny[lane] + first.z * nz[lane] > kHalfEvenCos;
      apart[lane] |= std::int32_t(!near) & std::int32_t(lane < left);
    });
  });
  return std::none_of(apart.begin(), apart.end(), [](std::int32_t a) { return a != 0; });
}

bool even(const SampledBlock& block, const SurfacePatch& patch) {
  const std::uint16_t* number = block.edges.numbers() + slotOf(patch.cell);
  const HermiteBlock& h = block.hermite;
  const auto normal = [&](unsigned bits) {
    const int i = number[kCellEdge[std::countr_zero(bits)].slot];
    return Vec3f{h.nx[i], h.ny[i], h.nz[i]};
  };
  const Vec3f first = normal(patch.edges);
  bool close = true;
  for (unsigned bits = patch.edges; bits != 0; bits &= bits - 1) close = close && dot(first, normal(bits)) > kEvenCos;
  return close;
}

/// A sign-changing edge of the patch at hand.
struct CrossedEdge {
  int inside, outside;  ///< Corners of its cell, x + 2y + 4z.
  double t;             ///< Where it crosses zero, from inside.
};

using AtCorners = std::array<double, kCorners>;

/// The corners of a cell from its centre, in world space, in voxels.
struct CellCorners {
  explicit CellCorners(const Mat3d& M) {
    for (int i = 0; i < kCorners; ++i) {
      const Vec3d p = M * fromCenter(i);
      x[i] = p.x;
      y[i] = p.y;
      z[i] = p.z;
    }
  }
  alignas(64) AtCorners x, y, z;
};

/// Some of a block's patches, by ascending index.
struct UnevenPatches {
  static constexpr int kMost = kBlockSize * kBlockSize * kBlockSize * 4;
  void add(std::size_t i) { index[count++] = static_cast<std::uint16_t>(i); }
  [[nodiscard]] std::span<const std::uint16_t> all() const { return {index.data(), static_cast<std::size_t>(count)}; }

  std::array<std::uint16_t, kMost> index;
  int count = 0;
};

/// Adds the rows of a stencil that the voxels about a cell look at (see VoxelPlanes): those two farther along each
/// axis, and the diagonal neighbours.
void needRowsAbout(const Coord& cell, DistanceStencil::Rows& rows) {
  constexpr std::array<unsigned, 8> kBits{0x3C, 0x7E, 0xFF, 0xFF, 0xFF, 0xFF, 0x7E, 0x3C};
  static_assert(DistanceStencil::kReach == 3);
  for (int x = 0; x < 8; ++x) rows[cell[0] + x] |= static_cast<std::uint16_t>(kBits[x] << cell[1]);
}

class PlaneFinder {
 public:
  PlaneFinder(const SampledBlock& block, const DistanceModel& model, const std::function<void(DistanceStencil&)>& read,
              FeaturePlanes& planes)
      : mBlock(block),
        mModel(model),
        mInverse(inverse(model.M)),
        mCorners(model.M),
        mRead(read),
        mPlanes(planes),
        mJumps(mStencil, creaseJump(model)),
        mVoxels(mStencil, tolerance(model.noise), matCast<float>(model.M)) {}

  /// Finds the planes of those among some patches at whose cells there are jumps.
  void run(UnevenPatches& patches) {
    mStencil.rows = {};
    for (const std::uint16_t i : patches.all()) needRowsAbout(mBlock.patches[i].cell.low(), mStencil.rows);
    mRead(mStencil);
    int jumping = 0;
    for (const std::uint16_t i : patches.all()) {
      const Coord cell = mBlock.patches[i].cell.low();
      if (mJumps.noneAt(cell)) continue;
      mVoxels.request(cell);
      patches.index[jumping++] = i;
    }
    patches.count = jumping;
    for (const std::uint16_t i : patches.all()) run(i);
  }

 private:
  void run(std::uint32_t i) {
    mPatch = i;
    const SurfacePatch& patch = mBlock.patches[i];
    mCell = patch.cell.low();
    mVoxels.gather(mCell, mSamples);
    CreaseSheets sheets = findSheets(mSamples, normalNoise(mModel.noise));
    if (sheets.count == 0) return;
    sheets.dropLight(leastShare(mModel.noise));
    gatherCrossings(patch);
    keepMeetingSheets(sheets);
  }

  void gatherCrossings(const SurfacePatch& patch) {
    const std::uint16_t* number = mBlock.edges.numbers() + slotOf(patch.cell);
    const auto inside = static_cast<unsigned>(cellCode(mBlock.signs, mCell[0], mCell[1], mCell[2]));
    mCrossingCount = 0;
    mMassPoint = {};
    for (unsigned bits = patch.edges; bits != 0; bits &= bits - 1) {
      const CellEdge& e = kCellEdge[std::countr_zero(bits)];
      const double t = mBlock.hermite.t[number[e.slot]];
      const bool up = (inside >> e.low & 1) != 0;
      mCrossing[mCrossingCount++] = {up ? e.low : e.high, up ? e.high : e.low, up ? t : 1 - t};
      Vec3d at = fromCenter(e.low);
      at[e.axis] += t;
      mMassPoint += mModel.M * at;
    }
    mMassPoint *= 1.0 / mCrossingCount;
  }

  /// Leaves out sheets that do not belong to the cell, and writes the planes of those that do.
  void keepMeetingSheets(CreaseSheets& sheets) {
    keepOwn(sheets);
    Vec3d y = meeting(sheets.all());
    while (sheets.count > 1 && farthestMiss(sheets.all(), y) > missed(mModel.noise)) {
      int farthest = 0;
      for (int i = 1; i < sheets.count; ++i)
        if (length(sheets.sheet[i].center - mMassPoint) > length(sheets.sheet[farthest].center - mMassPoint))
          farthest = i;
      sheets.drop(farthest);
      y = meeting(sheets.all());
    }
    write(sheets, y);
  }

  [[nodiscard]] Vec3d meeting(std::span<const CreaseSheet> sheets) const {
    return meetingPoint(sheets, mMassPoint, sheetSigma(mModel.noise));
  }

  static double farthestMiss(std::span<const CreaseSheet> sheets, const Vec3d& y) {
    double miss = 0;
    for (const CreaseSheet& s : sheets) miss = std::max(miss, std::abs(s.value(y)));
    return miss;
  }

  /// Leaves the sheets on which a crossing lies, and those that meet them within the cell.
  void keepOwn(CreaseSheets& sheets) const {
    if (sheets.count < 2) return;
    std::array<bool, CreaseSheets::kMax> crossed = crossedSheets(sheets);
    const auto keep = [&](int to, int i) {
      if (to == i) return;
      std::swap(sheets.sheet[to], sheets.sheet[i]);
      std::swap(crossed[to], crossed[i]);
    };
    int own = 0;
    for (int i = 0; i < sheets.count; ++i)
      if (crossed[i]) keep(own++, i);
    for (int i = own; i < sheets.count; ++i) {
      keep(own, i);
      const auto more = sheets.all().first(static_cast<std::size_t>(own) + 1);
      const Vec3d y = meeting(more), at = mInverse * y;
      if (farthestMiss(more, y) <= missed(mModel.noise) &&
          std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) <= 0.5 + margin(mModel.noise))
        ++own;
    }
    sheets.count = own;
  }

  /// On which sheets crossings lie. Sheets are endless, but of two that lie behind each other, a convex edge, the first
  /// that an edge meets on its way out ends the solid; of two before each other the last.
  [[nodiscard]] std::array<bool, CreaseSheets::kMax> crossedSheets(const CreaseSheets& sheets) const {
    constexpr double kSlack = 0.05;  // of an edge
    const int n = sheets.count;
    std::array<std::array<bool, CreaseSheets::kMax>, CreaseSheets::kMax> convex{};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j)
        convex[i][j] = convex[j][i] =
            sheets.sheet[i].value(sheets.sheet[j].center) + sheets.sheet[j].value(sheets.sheet[i].center) < 0;
    std::array<AtCorners, CreaseSheets::kMax> value;
    for (int i = 0; i < n; ++i) valueAtCorners(sheets.sheet[i], value[i]);
    std::array<bool, CreaseSheets::kMax> crossed{};
    for (int c = 0; c < mCrossingCount; ++c) {
      const CrossedEdge& edge = mCrossing[c];
      std::array<double, CreaseSheets::kMax> root{};
      for (int i = 0; i < n; ++i) {
        const double v0 = value[i][edge.inside], v1 = value[i][edge.outside];
        root[i] = v1 > v0 ? -v0 / (v1 - v0) : std::numeric_limits<double>::infinity();
      }
      const auto within = [](double t) { return t > -kSlack && t < 1 + kSlack; };
      bool found = false;
      int nearest = 0;
      for (int i = 0; i < n; ++i) {
        bool ends = within(root[i]);
        for (int j = 0; j < n; ++j)
          if (j != i && within(root[j])) ends = ends && (convex[i][j] ? root[i] <= root[j] : root[i] >= root[j]);
        crossed[i] = crossed[i] || ends;
        found = found || ends;
        if (std::abs(root[i] - edge.t) < std::abs(root[nearest] - edge.t)) nearest = i;
      }
      if (!found) crossed[nearest] = true;
    }
    return crossed;
  }

  void valueAtCorners(const CreaseSheet& sheet, AtCorners& value) const {
    withSimd(bestSimdLevel(), [&] {
      // Of its own, so that no store can change them: else the loop is not vectorised.
      const CreaseSheet s = sheet;
      AtCorners v;
      for (int i = 0; i < kCorners; ++i) v[i] = s.value({mCorners.x[i], mCorners.y[i], mCorners.z[i]});
      value = v;
    });
  }

  void write(const CreaseSheets& sheets, const Vec3d& y) {
    const auto first = static_cast<std::uint32_t>(mPlanes.planes.size());
    for (int i = 0; i < sheets.count; ++i) {
      const CreaseSheet& s = sheets.sheet[i];
      const Vec3d g = s.gradient(y);
      const double l = length(g);
      writePlane(y - g * (s.value(y) / (l * l)), g * (std::sqrt(std::min(s.weight, 1.0)) / l));
    }
    mPlanes.patches.push_back({mPatch, first, static_cast<std::uint32_t>(sheets.count), sheetSigma(mModel.noise)});
  }

  void writePlane(const Vec3d& point, const Vec3d& normal) {
    const Vec3d center{mCell[0] + 0.5, mCell[1] + 0.5, mCell[2] + 0.5};
    mPlanes.planes.push_back(
        {vecCast<float>(center + mInverse * point), vecCast<float>(mModel.M.transposed() * normal)});
  }

  const SampledBlock& mBlock;
  const DistanceModel& mModel;
  Mat3d mInverse;
  CellCorners mCorners;
  const std::function<void(DistanceStencil&)>& mRead;
  FeaturePlanes& mPlanes;

  DistanceStencil mStencil;
  GradientJumps mJumps;
  VoxelPlanes mVoxels;
  SurfaceSamples mSamples;
  std::uint32_t mPatch = 0;
  Coord mCell{};
  std::array<CrossedEdge, 12> mCrossing;
  int mCrossingCount = 0;
  Vec3d mMassPoint{};
};

}  // namespace

void findFeaturePlanes(const SampledBlock& block, const DistanceModel& model,
                       const std::function<void(DistanceStencil&)>& read, FeaturePlanes& planes) {
  if (block.patches.empty() || allEven(block)) return;
  UnevenPatches uneven;
  for (std::size_t i = 0; i < block.patches.size(); ++i)
    if (!even(block, block.patches[i])) uneven.add(i);
  if (uneven.count == 0) return;
  // A finder is too large for a stack and too large to be made for each block. It is taken while it is used, so that a
  // call from within `read` would make one of its own.
  static thread_local std::unique_ptr<std::optional<PlaneFinder>> idle;
  auto finder = std::exchange(idle, nullptr);
  if (finder == nullptr) finder = std::make_unique<std::optional<PlaneFinder>>();
  finder->emplace(block, model, read, planes).run(uneven);
  idle = std::move(finder);
}

}  // namespace pdc::detail
