#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pdc/io/open_input.h"
#include "pdc/io/volume/volume_reader.h"
#include "pdc/monitor.h"
#include "pdc/sample/dense/dense_source.h"

namespace pdc::detail {

/// How to read a dense volume, and as what.
struct OpenVolumeOptions {
  VolumeReadOptions read{};
  DenseSourceOptions source{};
  bool isoFromOtsu = false;  ///< The isovalue is otsuThreshold(), whatever the values are; then `source` has none.
};

/// A dense volume and the source that contours it.
struct OpenedVolume {
  DenseVolume volume;
  std::unique_ptr<const DenseSource> source;
  /// Of the file, then of what its values mean: a line each, which names the remedy by the program's option.
  std::vector<std::string> warnings;
};

/// \throws Error, with the file's name before it, as readVolume(), otsuThreshold() and DenseSource do; Cancelled.
[[nodiscard]] OpenedVolume openVolume(const std::filesystem::path& path, const OpenVolumeOptions& options,
                                      const Monitor& monitor);

/// The same of a volume that has been read already.
[[nodiscard]] OpenedVolume openVolume(DenseVolume volume, const OpenVolumeOptions& options, const Monitor& monitor);

/// What a contour of it takes.
[[nodiscard]] Input inputOf(OpenedVolume opened);

[[nodiscard]] InputVolume describe(const DenseVolume& volume);

}  // namespace pdc::detail
