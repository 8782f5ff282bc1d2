#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>

#include "io/file/byte_output.h"
#include "io/file/temporary_files.h"

namespace pdc::detail {

/// A file being written that appears under its name only when it is complete.
///
/// Bytes go to a temporary file in the target's folder; commit() synchronises it and renames it over the target, whose
/// permission bits are kept. Without commit() the destructor removes the temporary file and the target stays as it was.
/// A symbolic link is followed: the file it points to is replaced. What is not a regular file (a device, a pipe) cannot
/// be replaced and is written to directly.
class AtomicFile final : public ByteOutput {
 public:
  /// \throws Error if the target is a folder, may not be written, or no file can be made beside it.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();

  void write(const void* data, std::size_t size) override;
  /// Makes the file appear under its name; nothing can be written afterwards. \throws Error if that fails.
  void commit();
  [[nodiscard]] std::size_t bytesWritten() const { return mBytesWritten; }

 private:
  void openDevice();
  void openTemporary(mode_t permissions);
  void discard() noexcept;

  std::filesystem::path mPath;               ///< The path as given, for messages.
  std::filesystem::path mTarget;             ///< The path with links resolved.
  std::filesystem::path mTemporary;          ///< Empty if the target is written directly.
  std::optional<TemporaryFileEntry> mEntry;  ///< Lives as long as the temporary file.
  int mDescriptor = -1;
  std::size_t mBytesWritten = 0;
};

/// Makes the checks of AtomicFile's constructor, and no file. \throws Error as that does.
void checkWritable(const std::filesystem::path& path);

}  // namespace pdc::detail
