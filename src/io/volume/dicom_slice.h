#pragma once

#include <array>
#include <cstdint>

namespace pdc::detail {

/// What DICOM says of a slice: of a file, or of one frame of a file with several. Numbers that are not said are NaN.
struct DicomSlice {
  std::array<char, 72> series{}, description{};  ///< SeriesInstanceUID and SeriesDescription; each ends with a zero.
  std::int64_t seriesNumber = 0, instance = 0;
  std::int64_t file = 0, frame = 0, frames = 1;  ///< Which of the files that were looked at, which of its frames.
  std::int64_t columns = 0, rows = 0;
  std::int32_t bits = 0, storedBits = 0, isSigned = 0;  ///< Of a value.
  std::array<double, 3> position{};                     ///< ImagePositionPatient: the centre of the first pixel.
  std::array<double, 6> orientation{};  ///< ImageOrientationPatient: where columns count up, then where rows do.
  std::array<double, 2> spacing{};      ///< PixelSpacing: from row to row, then from column to column.
  double between = 0, thickness = 0;    ///< SpacingBetweenSlices, SliceThickness.
  double slope = 1, intercept = 0;
};

}  // namespace pdc::detail
