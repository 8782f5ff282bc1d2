#include "sample/dense/volume_sampler.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "math/lane_loops.h"
#include "sample/dense/key_ranges.h"
#include "sample/dense/stored_scalars.h"
#include "sample/stencils/pack_flags.h"

namespace pdc::detail {
namespace {

constexpr int kWord = 64;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

template <typename Scalar>
class TypedVolumeSampler final : public VolumeSampler {
 public:
  using Raw = typename Scalar::Raw;
  using Key = typename Scalar::Key;

  TypedVolumeSampler(const VolumeView& view, const ValueReading& reading)
      : VolumeSampler(view),
        mBounds(view.slope, view.intercept, reading),
        mRunAxis(runAxis(view)),
        mIso(reading.iso),
        mSign(reading.insideIsHigher ? -1.0F : 1.0F),
        mSinglePrecision(view.slope == 1 && view.intercept == 0 && kFitsFloat &&
                         static_cast<double>(static_cast<float>(reading.iso)) == reading.iso) {}

  RunRemarks insideBits(const Coord& first, Axis axis, int count, std::uint64_t* bits) const override {
    RunRemarks remarks;
    const StoredLine<Raw> line = lineFrom(first, axis);
    withSimd(mLevel, [&] {
      const ValueBounds<Scalar> bounds = mBounds;  // A copy on the stack, which no store can change.
      const bool checkFinite = bounds.finite.low != KeyOrder<Scalar>::key(0) ||
                               bounds.finite.high != KeyOrder<Scalar>::key(KeyOrder<Scalar>::last());
      Raw raw[kWord];
      for (int i = 0; i < count; i += kWord) {
        const StoredLine<Raw> from{line.from + i * line.step, line.step, line.swapped};
        const int left = std::min(kWord, count - i);
        if (left == kWord) {
          from.copy(kWord, raw);
        } else {
          from.copy(left, raw);
          std::fill(raw + left, raw + kWord, raw[left - 1]);
        }
        std::uint8_t flag[kWord];
        int on = 0, bad = 0;
        for (int k = 0; k < kWord; ++k) flag[k] = bounds.inside.holds(Scalar::key(raw[k]));
        if (!bounds.onIso.empty())
          for (int k = 0; k < kWord; ++k) on |= int(bounds.onIso.holds(Scalar::key(raw[k])));
        if (checkFinite)
          for (int k = 0; k < kWord; ++k) bad |= int(!bounds.finite.holds(Scalar::key(raw[k])));
        const std::uint64_t valid = ~std::uint64_t{0} >> (kWord - left);
        bits[i / kWord] = packFlags(flag) & valid;
        remarks.onIso |= std::uint64_t{on != 0} << i / kWord;
        remarks.allFinite = remarks.allFinite && bad == 0;
      }
    });
    return remarks;
  }

  [[nodiscard]] bool onIso(const Coord& point) const override {
    return !mBounds.onIso.empty() && mBounds.onIso.holds(Scalar::key(lineFrom(point, kAxisZ)[0]));
  }

  [[nodiscard]] double meaning(const Coord& point) const override {
    return view().slope * static_cast<double>(Scalar::number(lineFrom(point, kAxisZ)[0])) + view().intercept;
  }

  void read(const PointRows& box) const override {
    withSimd(mLevel, [&] {
      if (mRunAxis == kAxisZ) {
        readAlongZ(box);
      } else {
        readAcross(box);
      }
    });
  }

 private:
  /// Whether single precision holds all values of the type.
  static constexpr bool kFitsFloat = sizeof(Raw) <= 2 || std::is_same_v<Raw, float>;

  [[nodiscard]] StoredLine<Raw> lineFrom(const Coord& first, Axis axis) const {
    return {at(first), view().stride[axis], view().swapped};
  }

  /// As the function that is negative inside, kLanes values at once.
  void convert(const Raw* raw, float* to) const {
    const float sign = mSign;
    if (mSinglePrecision) {
      // Single precision gives what double precision would, as the isovalue is a float.
      const auto iso = static_cast<float>(mIso);
      for (int i = 0; i < kLanes; ++i) to[i] = (static_cast<float>(Scalar::number(raw[i])) - iso) * sign;
    } else {
      const double slope = view().slope, intercept = view().intercept, iso = mIso;
      for (int i = 0; i < kLanes; ++i)
        to[i] = static_cast<float>((slope * static_cast<double>(Scalar::number(raw[i])) + intercept) - iso) * sign;
    }
  }

  /// The part of a run of the box that lies in the volume, from its start on.
  struct Inner {
    int begin, end;
  };
  [[nodiscard]] Inner innerPart(const PointRows& box, Axis axis) const {
    const std::int64_t low = box.low[axis], size = view().size[axis];
    const auto within = [&](std::int64_t i) {
      return static_cast<int>(std::clamp<std::int64_t>(i, 0, box.size[axis]));
    };
    return {within(-low), within(size - low)};
  }

  /// Reads `count` values, at most kLanes.
  void readRun(const StoredLine<Raw>& line, int count, float* to) const {
    alignas(64) Raw raw[kLanes]{};
    alignas(64) float values[kLanes];
    // Constant counts make plain loads of it.
    switch (count) {
      case 11:
        line.copy(11, raw);
        break;
      case 15:
        line.copy(15, raw);
        break;
      case kLanes:
        line.copy(kLanes, raw);
        break;
      default:
        for (int i = 0; i < count; ++i) raw[i] = line[i];
    }
    convert(raw, values);
    if (count == 11) {
      std::copy_n(values, 11, to);
    } else {
      std::copy_n(values, count, to);
    }
  }

  void readAlongZ(const PointRows& box) const {
    const auto [begin, end] = innerPart(box, kAxisZ);
    for (int x = 0; x < box.size[0]; ++x)
      for (unsigned ys = box.rows[x]; ys != 0; ys &= ys - 1) {
        const int y = std::countr_zero(ys);
        float* to = box.to + x * box.step[0] + y * box.step[1];
        Coord first{box.low[0] + x, box.low[1] + y, box.low[2] + begin};
        if (begin >= end || !holds(first)) {
          std::fill_n(to, box.size[2], kUnknown);
          continue;
        }
        std::fill_n(to, begin, kUnknown);
        std::fill(to + end, to + box.size[2], kUnknown);
        readRun(lineFrom(first, kAxisZ), end - begin, to + begin);
      }
  }

  /// Reads along the axis that memory runs along, and puts what was read where it belongs.
  void readAcross(const PointRows& box) const {
    const Axis run = mRunAxis, other = run == kAxisX ? kAxisY : kAxisX;
    const std::array<int, 3> step{box.step[0], box.step[1], 1};
    const auto [begin, end] = innerPart(box, run);
    unsigned anyX = 0;
    for (int x = 0; x < box.size[0]; ++x) anyX |= box.rows[x];
    for (int z = 0; z < box.size[2]; ++z)
      for (int i = 0; i < box.size[other]; ++i) {
        if (run == kAxisX ? (anyX >> i & 1) == 0 : box.rows[i] == 0) continue;
        Coord first = box.low;
        first[2] += z;
        first[other] += i;
        first[run] += begin;
        alignas(64) float values[kLanes];
        std::fill_n(values, kLanes, kUnknown);
        if (begin < end && holds(first)) readRun(lineFrom(first, run), end - begin, values + begin);
        float* to = box.to + z + i * step[other];
        for (int k = 0; k < box.size[run]; ++k) to[k * step[run]] = values[k];
      }
  }

  ValueBounds<Scalar> mBounds;
  Axis mRunAxis;
  double mIso;
  float mSign;
  bool mSinglePrecision;
  SimdLevel mLevel = bestSimdLevel();
};

}  // namespace

std::unique_ptr<const VolumeSampler> makeVolumeSampler(const VolumeView& view, const ValueReading& reading) {
  return visitScalar(view.type, [&]<typename Scalar>(Scalar) -> std::unique_ptr<const VolumeSampler> {
    return std::make_unique<TypedVolumeSampler<Scalar>>(view, reading);
  });
}

Axis runAxis(const VolumeView& view) {
  const auto distance = [&](Axis axis) {
    const std::int64_t s = view.stride[axis];
    // Along an axis of one point there is nothing to run along.
    return view.size[axis] == 1 ? std::numeric_limits<std::uint64_t>::max()
                                : static_cast<std::uint64_t>(s < 0 ? -s : s);
  };
  Axis best = kAxisZ;
  for (const Axis axis : {kAxisY, kAxisX})
    if (distance(axis) < distance(best)) best = axis;
  return best;
}

}  // namespace pdc::detail
