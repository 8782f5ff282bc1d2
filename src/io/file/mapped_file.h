#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace pdc::detail {

/// The bytes of a file as memory that the system reads when it is looked at, and takes away again when it needs to.
/// What is written to it stays in memory. A file that becomes shorter meanwhile ends the process.
class MappedFile {
 public:
  /// \throws Error, which does not name the file, if it cannot be opened, is empty or not a regular file.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::span<char> bytes() const { return {mBytes, mSize}; }

  /// Lets go of the memory of these bytes but for what shares a page with others: what was written to them is lost, and
  /// they are read anew when they are looked at.
  void forget(std::size_t begin, std::size_t end) const;

 private:
  char* mBytes = nullptr;
  std::size_t mSize = 0;
};

}  // namespace pdc::detail
