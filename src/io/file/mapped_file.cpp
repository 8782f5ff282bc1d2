#include "io/file/mapped_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

#include "io/file/file_error.h"
#include "io/file/read_file.h"

namespace pdc::detail {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const int file = openForReading(path);
  mSize = static_cast<std::size_t>(::lseek(file, 0, SEEK_END));
  // Without MAP_NORESERVE files larger than the memory would be refused, because they could be written to.
  void* const memory = ::mmap(nullptr, mSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE, file, 0);
  const int error = errno;
  ::close(file);
  if (memory == MAP_FAILED) throw systemError("cannot be read", error);
  mBytes = static_cast<char*>(memory);
}

MappedFile::~MappedFile() { ::munmap(mBytes, mSize); }

void MappedFile::forget(std::size_t begin, std::size_t end) const {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t first = (begin + page - 1) / page * page, last = end / page * page;
  // It only saves memory, so what it says does not matter.
  if (first < last) ::madvise(mBytes + first, last - first, MADV_DONTNEED);
}

}  // namespace pdc::detail
