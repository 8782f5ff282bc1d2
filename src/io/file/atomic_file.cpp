#include "io/file/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <optional>
#include <utility>

#include "io/file/file_error.h"

namespace pdc::detail {
namespace {

namespace fs = std::filesystem;

/// Where a file has to be made or replaced, and what is there now.
struct Target {
  fs::path path;
  std::optional<struct stat> existing;

  [[nodiscard]] bool isDevice() const { return existing && !S_ISREG(existing->st_mode); }
  [[nodiscard]] fs::path folder() const {
    const fs::path parent = path.parent_path();
    return parent.empty() ? fs::path(".") : parent;
  }
};

/// Links are followed by hand, because the last one may point to a file that does not exist yet.
fs::path followLinks(const fs::path& path) {
  constexpr int kMaxLinks = 40;
  fs::path target = path;
  std::error_code error;
  for (int i = 0; fs::is_symlink(target, error); ++i) {
    if (i == kMaxLinks) throw fileError(path, "cannot be written", ELOOP);
    const fs::path next = fs::read_symlink(target, error);
    if (error) throw fileError(path, "cannot be written", error.value());
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

Target resolve(const fs::path& path) {
  if (path.empty()) throw Error("no output file given");
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) throw fileError(path, "cannot be written", errno);
    return {followLinks(path), std::nullopt};
  }
  if (S_ISDIR(status.st_mode)) throw fileError(path, "cannot be written", EISDIR);
  // Links to devices are left alone: those under /proc/self/fd lead to names that do not exist.
  if (!S_ISREG(status.st_mode)) return {path, status};
  return {followLinks(path), status};
}

void check(const fs::path& path, const Target& target) {
  if (target.existing && ::access(path.c_str(), W_OK) != 0) throw fileError(path, "cannot be written", errno);
  if (target.isDevice()) return;
  const fs::path folder = target.folder();
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) throw fileError(path, "folder " + folder.string(), errno);
  if (!S_ISDIR(status.st_mode)) throw fileError(path, "folder " + folder.string(), ENOTDIR);
  if (::access(folder.c_str(), W_OK | X_OK) != 0) throw fileError(path, "folder " + folder.string(), errno);
}

/// Failures are ignored: the file is complete and in place already, and some file systems cannot synchronise a folder.
void synchroniseFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void checkWritable(const fs::path& path) { check(path, resolve(path)); }

AtomicFile::AtomicFile(fs::path path) : mPath(std::move(path)) {
  const Target target = resolve(mPath);
  check(mPath, target);
  mTarget = target.path;
  if (target.isDevice()) {
    openDevice();
  } else {
    constexpr mode_t kPermissionBits = 07777;
    openTemporary(target.existing ? target.existing->st_mode & kPermissionBits : 0);
  }
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::openDevice() {
  mDescriptor = ::open(mTarget.c_str(), O_WRONLY | O_CLOEXEC);
  if (mDescriptor < 0) throw fileError(mPath, "cannot be written", errno);
}

/// \param permissions bits to set, or 0 to leave those of a new file.
void AtomicFile::openTemporary(mode_t permissions) {
  constexpr int kAttempts = 1000;
  static std::atomic<unsigned> counter{0};
  const fs::path folder = mTarget.parent_path();
  for (int i = 0; i < kAttempts && mDescriptor < 0; ++i) {
    mTemporary = folder / fmt::format(".pdc-{}-{}.tmp", ::getpid(), counter++);
    mDescriptor = ::open(mTemporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (mDescriptor < 0 && errno != EEXIST) break;
  }
  if (mDescriptor < 0) throw fileError(mPath, "cannot be written", errno);
  mEntry.emplace(mTemporary);
  if (permissions != 0 && ::fchmod(mDescriptor, permissions) != 0) {
    const int error = errno;
    discard();
    throw fileError(mPath, "cannot be given its permissions", error);
  }
}

void AtomicFile::write(const void* data, std::size_t size) {
  constexpr std::size_t kMaxWrite = std::size_t{1} << 30;  // Linux writes at most 2 GiB at a time.
  const char* next = static_cast<const char*>(data);
  for (std::size_t left = size; left > 0;) {
    const ssize_t n = ::write(mDescriptor, next, std::min(left, kMaxWrite));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw fileError(mPath, "cannot be written", errno);
    next += n;
    left -= static_cast<std::size_t>(n);
  }
  mBytesWritten += size;
}

void AtomicFile::commit() {
  // A pipe or a terminal has nothing to synchronise and says so.
  if (::fsync(mDescriptor) != 0 && !mTemporary.empty()) throw fileError(mPath, "cannot be written", errno);
  if (::close(std::exchange(mDescriptor, -1)) != 0) throw fileError(mPath, "cannot be written", errno);
  if (mTemporary.empty()) return;
  if (::rename(mTemporary.c_str(), mTarget.c_str()) != 0) throw fileError(mPath, "cannot be written", errno);
  mEntry.reset();
  const fs::path folder = std::exchange(mTemporary, fs::path()).parent_path();
  synchroniseFolder(folder.empty() ? fs::path(".") : folder);
}

void AtomicFile::discard() noexcept {
  if (mDescriptor >= 0) ::close(std::exchange(mDescriptor, -1));
  if (!mTemporary.empty()) ::unlink(mTemporary.c_str());
  mEntry.reset();
}

}  // namespace pdc::detail
