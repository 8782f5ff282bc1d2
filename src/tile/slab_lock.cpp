#include "tile/slab_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "io/file/file_error.h"

namespace pdc::detail {
namespace {

std::string ownName() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("{} process {}", host.data(), ::getpid());
}

/// Whether the path still names the open file: who held its lock before may have removed it.
bool isStillThere(const std::filesystem::path& path, int descriptor) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

}  // namespace

SlabLock::SlabLock(std::filesystem::path path, int descriptor) : mPath(std::move(path)), mDescriptor(descriptor) {}

SlabLock::SlabLock(SlabLock&& other) noexcept
    : mPath(std::move(other.mPath)), mDescriptor(std::exchange(other.mDescriptor, -1)) {}

SlabLock::~SlabLock() {
  if (mDescriptor < 0) return;
  // While it is locked, so that nobody's file but this one is removed.
  ::unlink(mPath.c_str());
  ::close(mDescriptor);
}

std::optional<SlabLock> SlabLock::take(const std::filesystem::path& path) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) throw fileError(path, "cannot be written", errno);
    SlabLock lock(path, descriptor);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      ::close(std::exchange(lock.mDescriptor, -1));
      if (error == EWOULDBLOCK) return std::nullopt;
      if (error == EINTR) continue;
      throw fileError(path, "cannot be locked", error);
    }
    if (!isStillThere(path, descriptor)) {
      ::close(std::exchange(lock.mDescriptor, -1));
      continue;
    }
    const std::string name = ownName();
    if (::ftruncate(descriptor, 0) != 0 || ::pwrite(descriptor, name.data(), name.size(), 0) < 0)
      throw fileError(path, "cannot be written", errno);
    return lock;
  }
}

std::string SlabLock::holder(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return "";
  std::string name;
  if (::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    std::array<char, 512> text{};
    const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
    name = size > 0 ? oneLine({text.data(), static_cast<std::size_t>(size)}) : "somebody";
  }
  ::close(descriptor);
  return name;
}

}  // namespace pdc::detail
