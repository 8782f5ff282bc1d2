#include "io/file/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "io/file/file_error.h"

namespace pdc::detail {
namespace {

/// Closes the file on all ways out.
struct Descriptor {
  int value;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

void checkRegular(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) throw systemError("cannot be read", EISDIR);
  if (!S_ISREG(status.st_mode)) throw Error("cannot be read: not a regular file");
  if (status.st_size == 0) throw Error("the file is empty");
}

}  // namespace

int openForReading(const std::filesystem::path& path) {
  // Without O_NONBLOCK a pipe that nobody writes to would be waited for before it is refused.
  Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  struct stat status {};
  if (file.value < 0 || ::fstat(file.value, &status) != 0) throw systemError("cannot be read", errno);
  checkRegular(status);
  return std::exchange(file.value, -1);
}

Buffer<char> readFile(const std::filesystem::path& path) {
  const Descriptor file{openForReading(path)};
  const auto size = static_cast<std::size_t>(::lseek(file.value, 0, SEEK_END));
  constexpr std::size_t kMaxRead = std::size_t{1} << 30;  // Linux reads at most 2 GiB at a time.
  Buffer<char> bytes(size);
  for (std::size_t done = 0; done < size;) {
    const ssize_t n =
        ::pread(file.value, bytes.data() + done, std::min(size - done, kMaxRead), static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw systemError("cannot be read", errno);
    if (n == 0) throw Error("cannot be read: it became shorter meanwhile");
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

}  // namespace pdc::detail
