#include "sample/creases/distance_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "math/lane_loops.h"
#include "sample/cell_edges.h"
#include "sample/creases/crease_sheets.h"
#include "sample/creases/gradient_jumps.h"
#include "sample/creases/sheet_selection.h"
#include "sample/creases/smooth_sheets.h"
#include "sample/creases/voxel_planes.h"

namespace pdc::detail {
namespace {

// The constants below were chosen with bench/feature_eval: the tuning shapes at 64³, noise 0, 0.02 and 0.1 voxels.

/// Crossings whose normals are within 2.5° of each other are coplanar: they leave no room for a crease. With 5° edges
/// were 4 to 14 % less exact.
constexpr float kCoplanarCosine = 0.999F;
/// Normals within 1.255° of one are within 2.51° of each other.
constexpr float kHalfCoplanarCosine = 0.99976F;

PlaneTolerance tolerance(double noise) {
  const auto n = static_cast<float>(noise);
  return {.cutoff = 0.04F + 2 * n, .scale = 0.001F + 2 * n, .jump = 0.005F + n};
}

/// Where slopes from both sides differ by less, at all corners of a cell, no crease turns by more than 20° there, or
/// noise or texture hide it. Plain gradients miss one that turns by 30° by 0.06 voxel. With 100 times the texture
/// vertices of an organic mesh were off by 1.7 times as much as with plain gradients, with 200 times by as much.
float creaseJump(const DistanceModel& model) {
  return static_cast<float>(std::max({0.2, 0.01 + 2 * model.noise, 200 * model.texture}));
}

/// Sheets with less than this share of the largest support are samples that noise has turned aside.
double leastShare(double noise) { return std::min(0.1, 10 * noise * noise); }

/// Sheets that bend more, per voxel, hold too few samples for a good fit: crossings then serve better.
constexpr double kMostBend = 0.3;

/// Vertices on a sheet make faces that lie inside of it, by a twelfth of the trace of its bend in the mean over squares
/// of one voxel: half-way out the faces' mean is on it.
constexpr double kFaceSag = 1.0 / 12;

/// How far crossings may be from a smooth sheet without a crease nearby, RMS.
double mostSheetError(double noise) { return 0.03 + 2 * noise; }

/// How far crossings may be from the nearest of several sheets: linear ones miss creases by more the more these turn.
/// On convex fillets of one voxel or two, which look like creases from farther away, they are off by more.
double mostCreaseError(double noise, const CreaseSheets& sheets) {
  constexpr double kConcave = 1.6;  // Beside concave creases rasterised distances are off by more.
  double cosine = 1, factor = 1;
  for (const CreaseSheet& a : sheets.all())
    for (const CreaseSheet& b : sheets.all()) {
      cosine = std::min(cosine, dot(a.normal, b.normal));
      if (a.value(b.center) + b.value(a.center) > 0) factor = kConcave;
    }
  return factor * (0.12 + 0.125 * (1 - cosine)) + 1.5 * noise;
}

/// The standard deviation that is expected of each component of a sample's normal.
double normalNoise(double noise) { return kNormalNoise * noise; }

/// True only if all of a block's crossings are coplanar, as most blocks' are. Some such blocks are not found.
bool allCoplanar(const SampledBlock& block) {
  const HermiteBlock& h = block.hermite;
  const int count = block.edges.size();
  alignas(64) std::array<std::int32_t, kLanes> apart{};
  forEachBatch(bestSimdLevel(), batchCount(static_cast<std::size_t>(count)), [&](std::size_t i) {
    const Vec3f first{h.nx[0], h.ny[0], h.nz[0]};
    const float *nx = &h.nx[i * kLanes], *ny = &h.ny[i * kLanes], *nz = &h.nz[i * kLanes];
    const int left = count - static_cast<int>(i) * kLanes;
    forEachLane([&](int lane) {
      const bool near = first.x * nx[lane] + first.y * ny[lane] + first.z * nz[lane] > kHalfCoplanarCosine;
      apart[lane] |= std::int32_t(!near) & std::int32_t(lane < left);
    });
  });
  return std::none_of(apart.begin(), apart.end(), [](std::int32_t a) { return a != 0; });
}

/// True if a patch's crossings are coplanar.
bool coplanar(const SampledBlock& block, const SurfacePatch& patch) {
  const std::uint16_t* number = block.edges.numbers() + slotOf(patch.cell);
  const HermiteBlock& h = block.hermite;
  const auto normal = [&](unsigned bits) {
    const int i = number[kCellEdge[std::countr_zero(bits)].slot];
    return Vec3f{h.nx[i], h.ny[i], h.nz[i]};
  };
  const Vec3f first = normal(patch.edges);
  bool close = true;
  for (unsigned bits = patch.edges; bits != 0; bits &= bits - 1)
    close = close && dot(first, normal(bits)) > kCoplanarCosine;
  return close;
}

/// The patches of a block beside which there may be a crease, by ascending index.
struct CandidatePatches {
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
        mSelection(model.M, model.noise),
        mRead(read),
        mPlanes(planes),
        mJumps(mStencil, creaseJump(model)),
        mVoxels(mStencil, tolerance(model.noise), matCast<float>(model.M)) {}

  /// Finds the planes of those among some patches at whose cells there are jumps.
  void run(CandidatePatches& patches) {
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
    const double noise = mModel.noise;
    CreaseSheets sheets = findSheets(mSamples, normalNoise(noise), mWeights);
    if (sheets.count == 0) return;
    sheets.dropUnsupported(leastShare(noise));
    joinSmoothSheets(mSamples, normalNoise(noise), sheets, mWeights);
    const PatchCrossings crossings = crossingsOf(patch);
    CreaseSheets met = sheets;
    const Vec3d y = mSelection.select(crossings, met);
    const double error = mSelection.crossingError(crossings, sheets.all());
    if (met.count > 1) {
      if (error <= mostCreaseError(noise, met)) write(met, y);
      return;
    }
    const int best = mSelection.nearest(crossings, sheets.all());
    CreaseSheets one;
    one.sheet[one.count++] = sheets.sheet[best];
    if (one.sheet[0].bendSize() > kMostBend || (sheets.count == 1 && error > mostSheetError(noise))) return;
    one.sheet[0].offset += kFaceSag * one.sheet[0].traceOfBend();
    write(one, mSelection.meeting(crossings, one.all()));
  }

  [[nodiscard]] PatchCrossings crossingsOf(const SurfacePatch& patch) const {
    const std::uint16_t* number = mBlock.edges.numbers() + slotOf(patch.cell);
    const auto inside = static_cast<unsigned>(cellCode(mBlock.signs, mCell[0], mCell[1], mCell[2]));
    PatchCrossings crossings;
    for (unsigned bits = patch.edges; bits != 0; bits &= bits - 1) {
      const CellEdge& e = kCellEdge[std::countr_zero(bits)];
      const double t = mBlock.hermite.t[number[e.slot]];
      const bool up = (inside >> e.low & 1) != 0;
      crossings.edge[crossings.count++] = {up ? e.low : e.high, up ? e.high : e.low, up ? t : 1 - t};
      Vec3d at = cornerFromCenter(e.low);
      at[e.axis] += t;
      crossings.massPoint += mModel.M * at;
    }
    crossings.massPoint *= 1.0 / crossings.count;
    return crossings;
  }

  void write(const CreaseSheets& sheets, const Vec3d& y) {
    const auto first = static_cast<std::uint32_t>(mPlanes.planes.size());
    for (int i = 0; i < sheets.count; ++i) {
      const CreaseSheet& s = sheets.sheet[i];
      const Vec3d g = s.gradient(y);
      const double l = length(g);
      writePlane(y - g * (s.value(y) / (l * l)), g * (std::sqrt(std::min(s.support, 1.0)) / l));
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
  SheetSelection mSelection;
  const std::function<void(DistanceStencil&)>& mRead;
  FeaturePlanes& mPlanes;

  DistanceStencil mStencil;
  GradientJumps mJumps;
  VoxelPlanes mVoxels;
  SurfaceSamples mSamples;
  SheetWeights mWeights;
  std::uint32_t mPatch = 0;
  Coord mCell{};
};

}  // namespace

void findFeaturePlanes(const SampledBlock& block, const DistanceModel& model,
                       const std::function<void(DistanceStencil&)>& read, FeaturePlanes& planes) {
  if (block.patches.empty() || allCoplanar(block)) return;
  CandidatePatches candidates;
  for (std::size_t i = 0; i < block.patches.size(); ++i)
    if (!coplanar(block, block.patches[i])) candidates.add(i);
  if (candidates.count == 0) return;
  // A finder is too large for a stack and too large to be made for each block. It is taken while it is used, so that a
  // call from within `read` would make one of its own.
  static thread_local std::unique_ptr<std::optional<PlaneFinder>> idle;
  auto finder = std::exchange(idle, nullptr);
  if (finder == nullptr) finder = std::make_unique<std::optional<PlaneFinder>>();
  finder->emplace(block, model, read, planes).run(candidates);
  idle = std::move(finder);
}

}  // namespace pdc::detail
