#pragma once

#include <filesystem>

namespace pdc::detail {

/// The temporary files that this process has not finished yet. While one of these lives, removeTemporaryFiles() knows
/// its file.
class TemporaryFileEntry {
 public:
  explicit TemporaryFileEntry(const std::filesystem::path& path) noexcept;
  ~TemporaryFileEntry();
  TemporaryFileEntry(const TemporaryFileEntry&) = delete;
  TemporaryFileEntry& operator=(const TemporaryFileEntry&) = delete;

 private:
  int mSlot;
};

/// Removes them all. For a signal handler that ends the process at once: async-signal-safe.
void removeTemporaryFiles() noexcept;

}  // namespace pdc::detail
