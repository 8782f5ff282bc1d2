#pragma once

#include <filesystem>

#include "io/volume/volume_header.h"

namespace pdc::detail {

/// Whether it is a .dcm file, or a folder with a file in it that begins as DICOM does.
[[nodiscard]] bool isDicom(const std::filesystem::path& path);

/// A DICOM file, of one or several frames, or a folder of such files. Slices are in the order of their positions along
/// the normal of their planes, and the steps from slice to slice are from the positions, too. GDCM decodes them in a
/// child process. \throws Error, also where this build has no GDCM; Cancelled.
[[nodiscard]] VolumeHeader readDicomSeries(const std::filesystem::path& path, const VolumeReadOptions& options,
                                           const Monitor& monitor);

}  // namespace pdc::detail
