#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pdc/monitor.h"
#include "pdc/sample/dense/volume_view.h"

namespace pdc {

/// How often values of a volume occur, in the meaning of the values. Values that are not finite are only counted.
struct ValueHistogram {
  double lowest = 0, highest = 0;    ///< The range of finite values; 0 if there are none.
  std::uint64_t finite = 0;          ///< Values that are finite,
  std::uint64_t nonFinite = 0;       ///< and all others.
  std::uint64_t between = 0;         ///< Finite values that are neither the lowest nor the highest.
  std::vector<std::uint64_t> count;  ///< Finite values in each of the bins, which are equally wide.

  /// Bin i holds values from `lowest` + i · width() up, the last one `highest` too. 0 where all values are equal.
  [[nodiscard]] double width() const {
    return count.empty() ? 0 : (highest / double(count.size()) - lowest / double(count.size()));
  }
};

/// Where a histogram parts best into two classes.
struct OtsuThreshold {
  double value = 0;  ///< In the meaning of the values.
  /// The share of the variance that lies between the classes, in [0, 1]: near 1 where the volume has two values and
  /// little noise, 0.75 for values that are spread evenly.
  double separation = 0;
};

/// Counts all values of a volume, in parallel on the calling thread's arena. The same for any number of threads and any
/// strides. \param bins at least 1. \param mask null, or which points count: see DenseSourceOptions.
/// \throws std::invalid_argument for a view without data or no bins; Error for a volume that DenseSource refuses;
/// Cancelled.
[[nodiscard]] ValueHistogram valueHistogram(const VolumeView& values, int bins = 1024, const Monitor& monitor = {},
                                            const VolumeView* mask = nullptr);

/// The bound between bins that gives the classes below and above it the largest variance between them (N. Otsu, A
/// threshold selection method from gray-level histograms, 1979), the middle of all such if there are many: half-way
/// between the two values of a volume of two. Nothing if all values are equal, or none is finite.
[[nodiscard]] std::optional<OtsuThreshold> otsuThreshold(const ValueHistogram& histogram);
[[nodiscard]] std::optional<OtsuThreshold> otsuThreshold(const VolumeView& values, const Monitor& monitor = {});

}  // namespace pdc
