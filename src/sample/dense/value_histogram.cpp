#include "pdc/sample/dense/value_histogram.h"

#include <algorithm>
#include <stdexcept>

#include "sample/dense/check_volume.h"
#include "sample/dense/volume_scan.h"

namespace pdc {
namespace {

struct Counts {
  std::uint64_t nonFinite = 0, lowest = 0, highest = 0;
  std::vector<std::uint64_t> bin;

  Counts& operator+=(const Counts& other) {
    nonFinite += other.nonFinite;
    lowest += other.lowest;
    highest += other.highest;
    if (bin.size() < other.bin.size()) bin.resize(other.bin.size());
    for (std::size_t i = 0; i < other.bin.size(); ++i) bin[i] += other.bin[i];
    return *this;
  }
};

}  // namespace

ValueHistogram valueHistogram(const VolumeView& values, int bins, const Monitor& monitor, const VolumeView* mask) {
  if (bins < 1) throw std::invalid_argument("valueHistogram: no bins");
  detail::checkVolume(values, "the volume");
  const detail::ValueRange range = detail::valueRange(values, mask, monitor);
  const std::unique_ptr<const detail::VolumeSampler> maskSampler =
      mask != nullptr ? detail::makeMaskSampler(*mask) : nullptr;
  const double low = range.low <= range.high ? range.low : 0, high = range.low <= range.high ? range.high : 0;
  // Halves, as the range itself may be too large for a number.
  const double half = 0.5 * high - 0.5 * low, perHalf = half > 0 ? 0.5 * bins / half : 0;
  const Counts counts = detail::visitScalar(values.type, [&]<typename Scalar>(Scalar) {
    return detail::scanVolume<Scalar, Counts>(
        values, maskSampler.get(), monitor, [&](Counts& part, const typename Scalar::Raw* raw, int count) {
          part.bin.resize(static_cast<std::size_t>(bins));
          for (int i = 0; i < count; ++i) {
            const double v = values.slope * static_cast<double>(Scalar::number(raw[i])) + values.intercept;
            if (!std::isfinite(v)) {
              ++part.nonFinite;
              continue;
            }
            part.lowest += std::uint64_t{v == low};
            part.highest += std::uint64_t{v == high};
            const double place = 2 * ((0.5 * v - 0.5 * low) * perHalf);
            ++part.bin[static_cast<std::size_t>(std::min(static_cast<int>(place), bins - 1))];
          }
        });
  });
  ValueHistogram histogram{.lowest = low, .highest = high, .nonFinite = counts.nonFinite, .count = counts.bin};
  histogram.count.resize(static_cast<std::size_t>(bins));
  for (const std::uint64_t n : histogram.count) histogram.finite += n;
  histogram.between = histogram.finite - counts.lowest - (high > low ? counts.highest : 0);
  return histogram;
}

std::optional<OtsuThreshold> otsuThreshold(const ValueHistogram& histogram) {
  const std::size_t bins = histogram.count.size();
  if (histogram.finite == 0 || !(histogram.highest > histogram.lowest) || bins < 2) return std::nullopt;
  // Places in bins, from the lowest value: (i + 0.5) of all.
  double sum = 0, squares = 0;
  const auto total = static_cast<double>(histogram.finite);
  for (std::size_t i = 0; i < bins; ++i) {
    const double n = static_cast<double>(histogram.count[i]) / total, place = static_cast<double>(i) + 0.5;
    sum += n * place;
    squares += n * place * place;
  }
  double share = 0, below = 0, best = -1;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i + 1 < bins; ++i) {
    const double n = static_cast<double>(histogram.count[i]) / total;
    share += n;
    below += n * (static_cast<double>(i) + 0.5);
    if (!(share > 0 && share < 1)) continue;
    const double apart = sum * share - below, between = apart * apart / (share * (1 - share));
    constexpr double kSame = 1e-9;
    if (between > best * (1 + kSame)) first = i;
    if (between >= best * (1 - kSame)) last = i;
    best = std::max(best, between);
  }
  if (best < 0) return std::nullopt;
  const double place = (0.5 * static_cast<double>(first + last) + 1) / static_cast<double>(bins);
  const double variance = squares - sum * sum;
  return OtsuThreshold{.value = histogram.lowest * (1 - place) + histogram.highest * place,
                       .separation = variance > 0 ? std::clamp(best / variance, 0.0, 1.0) : 1};
}

std::optional<OtsuThreshold> otsuThreshold(const VolumeView& values, const Monitor& monitor) {
  return otsuThreshold(valueHistogram(values, 1024, monitor));
}

}  // namespace pdc
