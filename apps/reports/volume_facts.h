#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "pdc/io/volume/volume_reader.h"
#include "pdc/render/image.h"
#include "pdc/sample/dense/value_histogram.h"

namespace pdc {

/// What `pdc info` says about a dense volume.
struct VolumeFacts {
  nlohmann::ordered_json facts;  ///< Without the file's name; the histogram has 16 bins.
  ValueHistogram histogram;
  std::optional<OtsuThreshold> threshold;
};

/// Reads all values. \throws Error for files that cannot be read; Cancelled.
[[nodiscard]] VolumeFacts gatherVolumeFacts(const std::filesystem::path& path, const VolumeReadOptions& options,
                                            const Monitor& monitor);

/// Prints a line of '#' for each bin of the histogram in the facts, on a logarithmic scale.
void printHistogram(const nlohmann::ordered_json& facts);

/// A picture of a histogram, 1024 by 512 pixels: counts from low to high values, linear in dark and logarithmic in
/// light, and the threshold as a red line.
[[nodiscard]] Image drawHistogram(const ValueHistogram& histogram, const std::optional<OtsuThreshold>& threshold);

}  // namespace pdc
