#include "sample/creases/crease_sheets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "math/lane_loops.h"
#include "pdc/math/solvers.h"
#include "sample/creases/noisy_sheet.h"
#include "sample/creases/sheet_cosine.h"

namespace pdc::detail {
namespace {

/// Samples with less support found no sheet.
constexpr float kLeastSeed = 0.02F;
/// Curvatures that are common, per voxel: noise in the normals that would look larger is smoothed away.
constexpr double kUsualBend = 0.1;

/// The blocks of lanes in which a sample has support, a bit each.
using LiveBlocks = std::uint64_t;
static_assert(SurfaceSamples::kCapacity / kLanes < 64);

LiveBlocks allBlocks(const SurfaceSamples& samples) { return (LiveBlocks{1} << samples.blocks()) - 1; }

/// The sample with the largest fit weight that may found a sheet, of several the first; -1 if there is none.
int findSeed(const SurfaceSamples& samples, LiveBlocks live) {
  alignas(64) std::array<float, kLanes> most{};
  alignas(64) std::array<std::int32_t, kLanes> at{};
  for (; live != 0; live &= live - 1) {
    const int first = std::countr_zero(live) * kLanes;
    const float *support = &samples.column[SurfaceSamples::kSupport][first],
                *fitWeight = &samples.column[SurfaceSamples::kFitWeight][first];
    forEachLane([&](int lane) {
      const float before = most[lane], own = fitWeight[lane], t = support[lane] > kLeastSeed ? own : 0.0F;
      const std::int32_t i = first + lane, earlier = at[lane];
      const bool more = t > before;
      at[lane] = more ? i : earlier;
      most[lane] = more ? t : before;
    });
  }
  const float best = maxLanes(most.data());
  if (!(best > 0)) return -1;
  forEachLane([&](int lane) { at[lane] = most[lane] == best ? at[lane] : SurfaceSamples::kCapacity; });
  return minLanes(at.data());
}

/// The samples' columns from a lane on.
struct LanePointers {
  LanePointers(SurfaceSamples& samples, int block) {
    for (int c = 0; c < SurfaceSamples::kColumns; ++c) column[c] = &samples.column[c][block * kLanes];
  }
  [[nodiscard]] Vec3f normal(int lane) const { return {column[0][lane], column[1][lane], column[2][lane]}; }
  std::array<float*, SurfaceSamples::kColumns> column;
};

/// The direction of the weighted mean of the normals that are like `mean`; `mean` itself if there are none.
Vec3f meanNormal(SurfaceSamples& samples, LiveBlocks live, const Vec3f& mean) {
  alignas(64) std::array<std::array<float, kLanes>, 3> sum{};
  for (; live != 0; live &= live - 1) {
    const LanePointers p(samples, std::countr_zero(live));
    forEachLane([&](int lane) {
      const Vec3f n = p.normal(lane);
      const float t = dot(n, mean) > kSheetCosine ? p.column[SurfaceSamples::kFitWeight][lane] : 0.0F;
      sum[0][lane] += n.x * t;
      sum[1][lane] += n.y * t;
      sum[2][lane] += n.z * t;
    });
  }
  const Vec3f s{sumLanes(sum[0].data()), sumLanes(sum[1].data()), sumLanes(sum[2].data())};
  const float l = length(s);
  return l > 0 ? s * (1 / l) : mean;
}

/// Sums over the samples whose normals are like `mean`, and takes their support from them. \param inSheet gets their
/// fit weights, and 0 for other samples, in live blocks.
void takeLike(SurfaceSamples& samples, LiveBlocks& live, const Vec3f& mean, SheetMoments& moments, float* inSheet) {
  alignas(64) std::array<std::array<float, kLanes>, SheetMoments::kCount> sum{};
  for (LiveBlocks blocks = live; blocks != 0; blocks &= blocks - 1) {
    const int block = std::countr_zero(blocks);
    const LanePointers p(samples, block);
    float *support = p.column[SurfaceSamples::kSupport], *fitWeight = p.column[SurfaceSamples::kFitWeight];
    const float *fx = p.column[SurfaceSamples::kFootX], *fy = p.column[SurfaceSamples::kFootY],
                *fz = p.column[SurfaceSamples::kFootZ];
    float* own = inSheet + block * kLanes;
    forEachLane([&](int lane) {
      const Vec3f n = p.normal(lane);
      const bool like = dot(n, mean) > kSheetCosine;
      const float s = like ? support[lane] : 0.0F, t = like ? fitWeight[lane] : 0.0F;
      support[lane] = like ? 0.0F : support[lane];
      fitWeight[lane] = like ? 0.0F : fitWeight[lane];
      own[lane] = t;
      const Vec3f f{fx[lane], fy[lane], fz[lane]}, tn = n * t, tf = f * t;
      sum[SheetMoments::kSupport][lane] += s;
      sum[SheetMoments::kFitWeight][lane] += t;
      const auto add = [&](int first, float x, float y, float z) {
        sum[first][lane] += x;
        sum[first + 1][lane] += y;
        sum[first + 2][lane] += z;
      };
      add(SheetMoments::kNormal, tn.x, tn.y, tn.z);
      add(SheetMoments::kFoot, tf.x, tf.y, tf.z);
      add(SheetMoments::kFootFoot, tf.x * f.x, tf.x * f.y, tf.x * f.z);
      add(SheetMoments::kFootFoot + 3, tf.y * f.y, tf.y * f.z, tf.z * f.z);
      add(SheetMoments::kNormalFoot, tn.x * f.x, tn.x * f.y, tn.x * f.z);
      add(SheetMoments::kNormalFoot + 3, tn.y * f.x, tn.y * f.y, tn.y * f.z);
      add(SheetMoments::kNormalFoot + 6, tn.z * f.x, tn.z * f.y, tn.z * f.z);
    });
    if (!(maxLanes(support) > 0)) live &= ~(LiveBlocks{1} << block);
  }
  for (int k = 0; k < SheetMoments::kCount; ++k) moments.sum[k] = double{sumLanes(sum[k].data())};
}

/// The plane through the mean foot point with the mean normal.
CreaseSheet meanSheet(const SheetMoments& moments) {
  const double fitWeight = moments.sum[SheetMoments::kFitWeight];
  CreaseSheet sheet{};
  sheet.support = moments.sum[SheetMoments::kSupport];
  sheet.moments = moments;
  sheet.center = moments.vector(SheetMoments::kFoot) * (1 / fitWeight);
  const Vec3d sum = moments.vector(SheetMoments::kNormal);
  sheet.normal = sum * (1 / length(sum));
  return sheet;
}

/// Bends a plane as the change of the normals says.
void bendSheet(const SheetMoments& moments, double normalNoise, CreaseSheet& sheet) {
  const auto& sum = moments.sum;
  const double fitWeight = sum[SheetMoments::kFitWeight];
  // Least squares for n(p) − mean = H(p − center), with a ridge.
  const double* ff = &sum[SheetMoments::kFootFoot];
  const SymMat3<double> spread =
      SymMat3<double>{ff[0], ff[1], ff[2], ff[3], ff[4], ff[5]} - outer(sheet.center) * fitWeight;
  const double noise = normalNoise / kUsualBend;
  const SymMat3<double> damped = spread.plusDiagonal((0.01 + noise * noise) * fitWeight);
  const Vec3d normals = moments.vector(SheetMoments::kNormal);
  for (int k = 0; k < 3; ++k) {
    const Vec3d turn = moments.vector(SheetMoments::kNormalFoot + 3 * k) - sheet.center * normals[k];
    const auto row = solveLdlt(damped, turn);
    sheet.bend.row[k] = row ? *row : Vec3d{};
  }
  // Only the tangential, symmetric part can be curvature.
  const Vec3d n = sheet.normal;
  Mat3d P;
  for (int k = 0; k < 3; ++k) P.row[k] -= n * n[k];
  const Mat3d t = sheet.bend.transposed();
  for (int k = 0; k < 3; ++k) sheet.bend.row[k] = (sheet.bend.row[k] + t.row[k]) * 0.5;
  sheet.bend = P * sheet.bend * P;
  // The mean of ½ dᵀHd is half the trace of H times the spread.
  const Mat3d& H = sheet.bend;
  const double bent = H.row[0].x * spread.xx + H.row[1].y * spread.yy + H.row[2].z * spread.zz +
                      2 * (H.row[0].y * spread.xy + H.row[0].z * spread.xz + H.row[1].z * spread.yz);
  sheet.offset = 0.5 * bent / fitWeight;
}

}  // namespace

void CreaseSheets::dropUnsupported(double share) {
  double most = 0;
  for (const CreaseSheet& s : all()) most = std::max(most, s.support);
  for (int i = count - 1; i >= 0; --i)
    if (sheet[i].support < share * most) drop(i);
}

CreaseSheets findSheets(SurfaceSamples& samples, double normalNoise, SheetWeights& weights, SimdLevel level) {
  CreaseSheets sheets;
  LiveBlocks live = allBlocks(samples);
  const bool noisy = isNoisy(normalNoise);
  withSimd(level, [&] {
    while (sheets.count < CreaseSheets::kMax) {
      const int seed = findSeed(samples, live);
      if (seed < 0) break;
      const Vec3f founder = samples.normal(seed);
      Vec3f mean = meanNormal(samples, live, meanNormal(samples, live, founder));
      if (!(dot(founder, mean) > kSheetCosine)) mean = founder;
      SheetMoments moments;
      auto& inSheet = weights.of[sheets.count];
      if (noisy) std::fill_n(inSheet.begin(), samples.blocks() * kLanes, 0.0F);
      takeLike(samples, live, mean, moments, inSheet.data());
      CreaseSheet& sheet = sheets.sheet[sheets.count++];
      sheet = meanSheet(moments);
      if (noisy) {
        const NoisyFit fit = fitNoisySheet(samples, inSheet.data(), sheet, normalNoise, level);
        sheet = fit.sheet;
        sheet.heightError = fit.heightError;
      } else {
        bendSheet(moments, normalNoise, sheet);
      }
      sheet.number = sheets.count - 1;
    }
  });
  return sheets;
}

CreaseSheet joinSheets(const SurfaceSamples& samples, const CreaseSheet& a, const CreaseSheet& b, double normalNoise,
                       SheetWeights& weights, SimdLevel level) {
  SheetMoments moments = a.moments;
  moments += b.moments;
  CreaseSheet joined = meanSheet(moments);
  joined.number = a.number;
  if (isNoisy(normalNoise)) {
    const auto &ofA = weights.of[a.number], &ofB = weights.of[b.number];
    for (int i = 0; i < samples.blocks() * kLanes; ++i) weights.joined[i] = ofA[i] + ofB[i];
    const NoisyFit fit = fitNoisySheet(samples, weights.joined.data(), joined, normalNoise, level);
    joined = fit.sheet;
    joined.heightError = fit.heightError;
  } else {
    bendSheet(moments, normalNoise, joined);
  }
  return joined;
}

Vec3d meetingPoint(std::span<const CreaseSheet> sheets, const Vec3d& start, double sigma) {
  constexpr int kSteps = 3;
  Vec3d y = start;
  for (int step = 0; step < kSteps; ++step) {
    const double ridge = sigma * sigma * static_cast<double>(sheets.size());
    SymMat3<double> A = SymMat3<double>::identity() * ridge;
    Vec3d b = (start - y) * ridge;
    for (const CreaseSheet& s : sheets) {
      const double w = std::min(s.support, 1.0);
      const Vec3d g = s.gradient(y);
      A += outer(g) * w;
      b -= g * (w * s.value(y));
    }
    const auto d = solveLdlt(A, b);
    if (!d) break;
    y += *d;
  }
  return y;
}

}  // namespace pdc::detail
