#include "pdc/mesh/mesh.h"

#include <sys/mman.h>

namespace pdc::detail {
namespace {

constexpr std::align_val_t kHugePage{std::size_t{2} << 20};

}  // namespace

void* allocateLarge(std::size_t bytes) {
  void* p = ::operator new(bytes, kHugePage);
  // Advice only: where it is not taken the memory is just slower to fill.
  (void)madvise(p, bytes, MADV_HUGEPAGE);
  return p;
}

void freeLarge(void* p) noexcept { ::operator delete(p, kHugePage); }

}  // namespace pdc::detail
