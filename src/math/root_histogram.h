#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace pdc::detail {

/// Numbers ≥ 0, given by their squares, counted by size: in quarters of octaves from 2⁻¹⁶ to 4, what is smaller
/// counts as zero, what is larger as 4.
class RootHistogram {
 public:
  static constexpr int kBins = 72;

  /// Where the root of a number is counted. Without branches, so that loops over lanes can be vectorised.
  [[nodiscard]] static std::int32_t bin(float squared) {
    const std::int32_t b = (std::bit_cast<std::int32_t>(squared) >> kMantissa) - kLowest, low = b < 0 ? 0 : b;
    return low < kBins ? low : kBins - 1;
  }
  void count(std::int32_t bin) { ++mCount[static_cast<std::size_t>(bin)]; }
  RootHistogram& operator+=(const RootHistogram& other) {
    for (std::size_t i = 0; i < kBins; ++i) mCount[i] += other.mCount[i];
    return *this;
  }
  [[nodiscard]] std::uint64_t total() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : mCount) sum += n;
    return sum;
  }
  /// The median of all and of `zeros` numbers that are zero, within a tenth; 0 if there are none.
  [[nodiscard]] double median(std::uint64_t zeros = 0) const {
    const double half = 0.5 * static_cast<double>(total() + zeros);
    auto below = static_cast<double>(zeros);
    if (half <= below) return 0;
    for (int i = 0; i < kBins; ++i) {
      const auto own = static_cast<double>(mCount[static_cast<std::size_t>(i)]);
      if (below + own >= half) {
        return i == 0 ? 0 : edge(i) + (half - below) / own * (edge(i + 1) - edge(i));
      }
      below += own;
    }
    return edge(kBins);
  }

 private:
  /// Bits that are dropped from a square: half an octave is left.
  static constexpr int kMantissa = 22;
  static constexpr std::int32_t kLowest = (127 - 32) << 1;

  /// The lower edge of a bin.
  [[nodiscard]] static double edge(int bin) {
    return std::sqrt(double{std::bit_cast<float>((bin + kLowest) << kMantissa)});
  }

  std::array<std::uint64_t, kBins> mCount{};
};

}  // namespace pdc::detail
