#pragma once

#include <filesystem>

namespace pdc::detail {

/// Makes a temporary file known to removeTemporaryFiles() while it lives. Safe from any thread. A few files find room;
/// further ones, and paths longer than PATH_MAX, stay unknown, which does no other harm.
class TemporaryFileEntry {
 public:
  explicit TemporaryFileEntry(const std::filesystem::path& path) noexcept;
  ~TemporaryFileEntry();
  TemporaryFileEntry(const TemporaryFileEntry&) = delete;
  TemporaryFileEntry& operator=(const TemporaryFileEntry&) = delete;

 private:
  int mSlot;
};

/// Removes the files of all entries. It is async-signal-safe, for handlers that end the process at once.
void removeTemporaryFiles() noexcept;

}  // namespace pdc::detail
