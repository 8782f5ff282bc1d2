#include "sample/creases/crease_sheets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "math/lane_loops.h"
#include "pdc/math/solvers.h"
#include "sample/creases/noisy_sheet.h"

namespace pdc::detail {
namespace {

/// Normals within 26° of a sheet's mean belong to it.
constexpr float kSameSheet = 0.9F;
/// Samples lighter than this found no sheet of their own.
constexpr float kLeastSeed = 0.02F;
/// Normals noisier than this do not say best how a sheet lies.
constexpr double kNoisy = 0.01;
/// Curvatures that are common, per voxel: noise in the normals that would look larger is smoothed away.
constexpr double kUsualBend = 0.1;

/// Sums over the samples of a sheet: of their weights, and, weighed by their trust, of ones, normals n, feet f, the six
/// products f fᵀ and the nine n fᵀ.
struct Moments {
  enum { kWeight, kTrust, kNormal, kFoot = kNormal + 3, kFootFoot = kFoot + 3, kNormalFoot = kFootFoot + 6 };
  static constexpr int kCount = kNormalFoot + 9;
  alignas(64) std::array<std::array<float, kLanes>, kCount> lanes{};
  std::array<double, kCount> sum;

  [[nodiscard]] Vec3d vector(int first) const { return {sum[first], sum[first + 1], sum[first + 2]}; }
};

/// The blocks of lanes whose samples are not all without weight, a bit each.
using LiveBlocks = std::uint64_t;
static_assert(SurfaceSamples::kCapacity / kLanes < 64);

LiveBlocks allBlocks(const SurfaceSamples& samples) { return (LiveBlocks{1} << samples.blocks()) - 1; }

/// The most trusted sample that may found a sheet, of several the first; -1 if there is none.
int findSeed(const SurfaceSamples& samples, LiveBlocks live) {
  alignas(64) std::array<float, kLanes> most{};
  alignas(64) std::array<std::int32_t, kLanes> at{};
  for (; live != 0; live &= live - 1) {
    const int first = std::countr_zero(live) * kLanes;
    const float *weight = &samples.column[SurfaceSamples::kWeight][first],
                *trust = &samples.column[SurfaceSamples::kTrust][first];
    forEachLane([&](int lane) {
      const float before = most[lane], own = trust[lane], t = weight[lane] > kLeastSeed ? own : 0.0F;
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

/// The direction of the trusted sum of the normals that are like `mean`; `mean` itself if there are none.
Vec3f meanNormal(SurfaceSamples& samples, LiveBlocks live, const Vec3f& mean) {
  alignas(64) std::array<std::array<float, kLanes>, 3> sum{};
  for (; live != 0; live &= live - 1) {
    const LanePointers p(samples, std::countr_zero(live));
    forEachLane([&](int lane) {
      const Vec3f n = p.normal(lane);
      const float t = dot(n, mean) > kSameSheet ? p.column[SurfaceSamples::kTrust][lane] : 0.0F;
      sum[0][lane] += n.x * t;
      sum[1][lane] += n.y * t;
      sum[2][lane] += n.z * t;
    });
  }
  const Vec3f s{sumLanes(sum[0].data()), sumLanes(sum[1].data()), sumLanes(sum[2].data())};
  const float l = length(s);
  return l > 0 ? s * (1 / l) : mean;
}

/// Sums over the samples whose normals are like `mean`, and takes their weight away. \param share gets their trust, in
/// live blocks.
void takeLike(SurfaceSamples& samples, LiveBlocks& live, const Vec3f& mean, Moments& moments, float* share) {
  auto& sum = moments.lanes;
  for (LiveBlocks blocks = live; blocks != 0; blocks &= blocks - 1) {
    const int block = std::countr_zero(blocks);
    const LanePointers p(samples, block);
    float *weight = p.column[SurfaceSamples::kWeight], *trust = p.column[SurfaceSamples::kTrust];
    const float *fx = p.column[SurfaceSamples::kFootX], *fy = p.column[SurfaceSamples::kFootY],
                *fz = p.column[SurfaceSamples::kFootZ];
    float* own = share + block * kLanes;
    forEachLane([&](int lane) {
      const Vec3f n = p.normal(lane);
      const bool like = dot(n, mean) > kSameSheet;
      const float w = like ? weight[lane] : 0.0F, t = like ? trust[lane] : 0.0F;
      weight[lane] = like ? 0.0F : weight[lane];
      trust[lane] = like ? 0.0F : trust[lane];
      own[lane] = t;
      const Vec3f f{fx[lane], fy[lane], fz[lane]}, tn = n * t, tf = f * t;
      sum[Moments::kWeight][lane] += w;
      sum[Moments::kTrust][lane] += t;
      const auto add = [&](int first, float x, float y, float z) {
        sum[first][lane] += x;
        sum[first + 1][lane] += y;
        sum[first + 2][lane] += z;
      };
      add(Moments::kNormal, tn.x, tn.y, tn.z);
      add(Moments::kFoot, tf.x, tf.y, tf.z);
      add(Moments::kFootFoot, tf.x * f.x, tf.x * f.y, tf.x * f.z);
      add(Moments::kFootFoot + 3, tf.y * f.y, tf.y * f.z, tf.z * f.z);
      add(Moments::kNormalFoot, tn.x * f.x, tn.x * f.y, tn.x * f.z);
      add(Moments::kNormalFoot + 3, tn.y * f.x, tn.y * f.y, tn.y * f.z);
      add(Moments::kNormalFoot + 6, tn.z * f.x, tn.z * f.y, tn.z * f.z);
    });
    if (!(maxLanes(weight) > 0)) live &= ~(LiveBlocks{1} << block);
  }
  for (int k = 0; k < Moments::kCount; ++k) moments.sum[k] = double{sumLanes(sum[k].data())};
}

/// The plane through the mean foot with the mean normal.
CreaseSheet meanSheet(const Moments& moments) {
  const double trust = moments.sum[Moments::kTrust];
  CreaseSheet sheet{};
  sheet.weight = moments.sum[Moments::kWeight];
  sheet.center = moments.vector(Moments::kFoot) * (1 / trust);
  const Vec3d sum = moments.vector(Moments::kNormal);
  sheet.normal = sum * (1 / length(sum));
  return sheet;
}

/// Bends a plane as the change of the normals says.
void bendSheet(const Moments& moments, double normalNoise, CreaseSheet& sheet) {
  const auto& sum = moments.sum;
  const double trust = sum[Moments::kTrust];
  // Least squares for n(p) − mean = H(p − center), with a ridge.
  const double* ff = &sum[Moments::kFootFoot];
  const SymMat3<double> spread =
      SymMat3<double>{ff[0], ff[1], ff[2], ff[3], ff[4], ff[5]} - outer(sheet.center) * trust;
  const double noise = normalNoise / kUsualBend;
  const SymMat3<double> damped = spread.plusDiagonal((0.01 + noise * noise) * trust);
  const Vec3d normals = moments.vector(Moments::kNormal);
  for (int k = 0; k < 3; ++k) {
    const Vec3d turn = moments.vector(Moments::kNormalFoot + 3 * k) - sheet.center * normals[k];
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
  sheet.offset = 0.5 * bent / trust;
}

}  // namespace

void CreaseSheets::dropLight(double share) {
  double heaviest = 0;
  for (const CreaseSheet& s : all()) heaviest = std::max(heaviest, s.weight);
  for (int i = count - 1; i >= 0; --i)
    if (sheet[i].weight < share * heaviest) drop(i);
}

CreaseSheets findSheets(SurfaceSamples& samples, double normalNoise, SimdLevel level) {
  CreaseSheets sheets;
  alignas(64) std::array<float, SurfaceSamples::kCapacity> share;
  LiveBlocks live = allBlocks(samples);
  const bool noisy = normalNoise > kNoisy;
  withSimd(level, [&] {
    while (sheets.count < CreaseSheets::kMax) {
      const int seed = findSeed(samples, live);
      if (seed < 0) break;
      const Vec3f founder = samples.normal(seed);
      Vec3f mean = meanNormal(samples, live, meanNormal(samples, live, founder));
      if (!(dot(founder, mean) > kSameSheet)) mean = founder;
      Moments moments;
      if (noisy) std::fill_n(share.begin(), samples.blocks() * kLanes, 0.0F);
      takeLike(samples, live, mean, moments, share.data());
      CreaseSheet& sheet = sheets.sheet[sheets.count++];
      sheet = meanSheet(moments);
      if (noisy) {
        sheet = fitNoisySheet(samples, share.data(), sheet, normalNoise, level);
      } else {
        bendSheet(moments, normalNoise, sheet);
      }
    }
  });
  return sheets;
}

Vec3d meetingPoint(std::span<const CreaseSheet> sheets, const Vec3d& start, double sigma) {
  constexpr int kSteps = 3;
  Vec3d y = start;
  for (int step = 0; step < kSteps; ++step) {
    const double ridge = sigma * sigma * static_cast<double>(sheets.size());
    SymMat3<double> A = SymMat3<double>::identity() * ridge;
    Vec3d b = (start - y) * ridge;
    for (const CreaseSheet& s : sheets) {
      const double w = std::min(s.weight, 1.0);
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
