#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pdc::detail {

/// The right to contour a slab: a lock of the system's on a file that names host and process. The system lets go of it
/// when the process ends, however it does.
class SlabLock {
 public:
  /// Nothing if another process holds it. \throws Error if the file cannot be made, or the file system has no locks.
  static std::optional<SlabLock> take(const std::filesystem::path& path);
  SlabLock(SlabLock&& other) noexcept;
  SlabLock& operator=(SlabLock&&) = delete;
  /// Lets go of it, and removes the file.
  ~SlabLock();

  /// Host and process of who holds it; empty if nobody does.
  [[nodiscard]] static std::string holder(const std::filesystem::path& path);

 private:
  SlabLock(std::filesystem::path path, int descriptor);

  std::filesystem::path mPath;
  int mDescriptor;
};

}  // namespace pdc::detail
