#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "pdc/monitor.h"
#include "pdc/sample/dense/volume_view.h"

namespace pdc::detail {

enum class VolumeEncoding {
  kRaw,
  kDeflated,      ///< With the header of gzip or zlib.
  kBareDeflated,  ///< Without, as in zip files.
  kText,          ///< Numbers in decimal.
};

/// A part of a file that holds values.
struct VolumePiece {
  std::filesystem::path path;
  std::uint64_t offset = 0;  ///< Where they begin in the file.
  std::uint64_t length = 0;  ///< Bytes of the file; 0: to its end.
  bool atEnd = false;        ///< Values that are not encoded are the file's last bytes; then `offset` does not count.
};

/// The values of a volume as they lie in files: pieces of equal size, one after the other.
struct VolumeData {
  std::vector<VolumePiece> pieces;
  VolumeEncoding encoding = VolumeEncoding::kRaw;
  std::uint64_t bytes = 0;  ///< Of all pieces once they are decoded.
  std::uint64_t skip = 0;   ///< Decoded bytes of each piece before its values.
  ScalarType type = ScalarType::kUint8;
};

/// Bytes in memory.
struct LoadedBytes {
  const std::byte* data = nullptr;
  std::shared_ptr<const void> owner;
};

/// Makes `count` of the decoded bytes from `begin` on available, mapped where that is possible. Nothing is allocated
/// that the files cannot fill. \param header is not named in errors. \throws Error if the files hold fewer bytes or are
/// damaged; Cancelled.
[[nodiscard]] LoadedBytes loadVolume(const VolumeData& data, std::uint64_t begin, std::uint64_t count,
                                     const std::filesystem::path& header, const Monitor& monitor);

}  // namespace pdc::detail
