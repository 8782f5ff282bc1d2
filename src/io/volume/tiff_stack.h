#pragma once

#include <filesystem>

#include "io/volume/volume_header.h"

namespace pdc::detail {

/// Whether it is a folder with .tif or .tiff files in it.
[[nodiscard]] bool isTiffFolder(const std::filesystem::path& path);

/// A .tif file of several pages, or a folder of such files of one page each, in the order of the numbers in their
/// names. libtiff decodes them in a child process. ImageJ's files give spacing, unit, channels and times; those beyond
/// 4 GB, which have one page for all, are mapped. \throws Error, also where this build has no libtiff; Cancelled.
[[nodiscard]] VolumeHeader readTiffStack(const std::filesystem::path& path, const VolumeReadOptions& options,
                                         const Monitor& monitor);

}  // namespace pdc::detail
