#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "io/volume/child_stream.h"
#include "io/volume/dicom_slice.h"

namespace pdc::detail {

/// The functions of the module `pdc_dicom.so`, which is linked with GDCM. It is loaded where a series is read and not
/// with each program: GDCM takes longer to load than most grids take to contour.
struct DicomModule {
  /// Writes the number of slices as an std::int64_t, then a DicomSlice for each one, file by file. Files that begin as
  /// DICOM but hold no pictures are passed over. \throws Error for damaged files, for more values than a file can
  /// hold, and for colours.
  void (*writeSlices)(const std::vector<std::filesystem::path>& files, ChildOutput& out);

  /// Writes the values of slices, rows from the top, in the machine's byte order and with the bits that are not stored
  /// set to the sign. \param slices as writeSlices() wrote them, in the order to write. \throws Error.
  void (*writeValues)(const std::vector<std::filesystem::path>& files, std::span<const DicomSlice> slices,
                      ChildOutput& out);
};

/// Loads the module, once: from `lib/pdc` beside the folder of the program or the library, or from where the package
/// was installed. \throws Error if it is in none of them.
[[nodiscard]] const DicomModule& dicomModule();

}  // namespace pdc::detail

/// What the module exports.
extern "C" [[gnu::visibility("default")]] const pdc::detail::DicomModule pdcDicomModule;
