#include "sample/dense/volume_scan.h"

#include <fmt/format.h>
#include <tbb/parallel_reduce.h>

#include <cmath>

#include "field/non_finite.h"

namespace pdc::detail {
namespace {

/// The least and the largest key; low > high if there were none.
template <typename Key>
struct KeySpan {
  Key low = std::numeric_limits<Key>::max(), high = std::numeric_limits<Key>::lowest();

  KeySpan& operator+=(const KeySpan& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    return *this;
  }
};

struct Count {
  std::size_t count = 0;
  Count& operator+=(const Count& other) {
    count += other.count;
    return *this;
  }
};

std::unique_ptr<const VolumeSampler> samplerOf(const VolumeView* mask) {
  return mask != nullptr ? makeMaskSampler(*mask) : nullptr;
}

}  // namespace

std::unique_ptr<const VolumeSampler> makeMaskSampler(const VolumeView& mask) {
  // What the number stands for does not matter.
  VolumeView plain = mask;
  plain.slope = 1;
  plain.intercept = 0;
  return makeVolumeSampler(plain, {.iso = 0, .insideIsHigher = true});
}

ValueRange valueRange(const VolumeView& view, const VolumeView* mask, const Monitor& monitor) {
  const auto maskSampler = samplerOf(mask);
  return visitScalar(view.type, [&]<typename Scalar>(Scalar) {
    using Key = typename Scalar::Key;
    const KeyRange<Key> finite = ValueBounds<Scalar>(view.slope, view.intercept, {}).finite;
    const auto span = scanVolume<Scalar, KeySpan<Key>>(
        view, maskSampler.get(), monitor, [finite](KeySpan<Key>& part, const typename Scalar::Raw* raw, int count) {
          Key low = part.low, high = part.high;
          for (int i = 0; i < count; ++i) {
            const Key k = Scalar::key(raw[i]);
            const bool counts = finite.holds(k);
            low = counts & (k < low) ? k : low;
            high = counts & (k > high) ? k : high;
          }
          part = {low, high};
        });
    ValueRange range;
    if (span.low > span.high) return range;
    for (const Key k : {span.low, span.high})
      range.add(view.slope * static_cast<double>(Scalar::number(Scalar::raw(k))) + view.intercept);
    return range;
  });
}

std::size_t countRefused(const VolumeView& view) {
  return visitScalar(view.type, [&]<typename Scalar>(Scalar) {
    using Key = typename Scalar::Key;
    const ValueBounds<Scalar> bounds(view.slope, view.intercept, {});  // Negative is inside.
    return scanVolume<Scalar, Count>(view, nullptr, {},
                                     [bounds](Count& part, const typename Scalar::Raw* raw, int count) {
                                       int refused = 0;
                                       for (int i = 0; i < count; ++i) {
                                         const Key k = Scalar::key(raw[i]);
                                         refused += int(!bounds.finite.holds(k)) | int(bounds.inside.holds(k));
                                       }
                                       part.count += static_cast<std::size_t>(refused);
                                     })
        .count;
  });
}

void requireFiniteValues(const VolumeSampler& values, const VolumeView* mask) {
  const auto maskSampler = samplerOf(mask);
  const VolumeView& view = values.view();
  using Found = NonFinite<Coord>;
  const Found found = tbb::parallel_reduce(
      tbb::blocked_range<std::int64_t>(0, view.size[0] * view.size[1]), Found(),
      [&](const auto& range, Found some) {
        for (std::int64_t row = range.begin(); row != range.end(); ++row) {
          Coord p{static_cast<std::int32_t>(row / view.size[1]), static_cast<std::int32_t>(row % view.size[1]), 0};
          for (; p[2] < view.size[2]; ++p[2]) {
            const double v = values.meaning(p);
            std::uint64_t bits = 1;
            if (std::isfinite(v)) continue;
            if (maskSampler != nullptr) maskSampler->insideBits(p, kAxisZ, 1, &bits);
            if (bits != 0) some.add(p, v);
          }
        }
        return some;
      },
      [](Found a, const Found& b) {
        a.add(b);
        return a;
      });
  if (found.count == 0) return;
  const Coord& at = found.first;
  failNonFinite(found.count, {"voxel", "voxels"}, fmt::format("({}, {}, {})", at[0], at[1], at[2]), found.value);
}

}  // namespace pdc::detail
