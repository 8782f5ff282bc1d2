#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/file/byte_output.h"

namespace pdc::detail {

/// Writes a zip archive of deflated entries, from front to back. finish() has to end it.
class ZipOutput {
 public:
  /// \param to has to live as long.
  explicit ZipOutput(ByteOutput& to) : mTo(to) {}

  /// Adds an entry of what `fill` writes. \throws Error where the archive would need more than 4 GiB; what `fill`
  /// throws passes through.
  void add(const std::string& name, const std::function<void(ByteOutput&)>& fill);
  /// Writes the directory.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint32_t begin, crc, deflated, size;
  };

  void write(const std::string& bytes);

  ByteOutput& mTo;
  std::vector<Entry> mEntries;
  std::uint64_t mWritten = 0;
};

}  // namespace pdc::detail
