#include "terminal/huge_heap.h"

#include <climits>
#include <cstdint>
#include <cstdlib>

#if defined(__linux__) && defined(__GLIBC__)

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace pdc {

void useHugePagesForHeap() {
  constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21;
  // Addresses that the heap grows into first; they take memory only when they are used.
  constexpr int kReserve = INT_MAX / static_cast<int>(kHugePage) * static_cast<int>(kHugePage);
  constexpr int kGrowth = 1 << 26, kLargestInHeap = 2 * static_cast<int>(kHugePage);
  mallopt(M_MMAP_THRESHOLD, kLargestInHeap);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_TOP_PAD, kReserve);
  const auto begin = (reinterpret_cast<std::uintptr_t>(sbrk(0)) + kHugePage - 1) / kHugePage * kHugePage;
  void* volatile grown = std::malloc(kHugePage);  // volatile: what is not used is not allocated.
  std::free(grown);
  mallopt(M_TOP_PAD, kGrowth);
  const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
  if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace pdc

#else

namespace pdc {

void useHugePagesForHeap() {}

}  // namespace pdc

#endif
