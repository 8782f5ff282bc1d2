#include "pdc/mesh/mesh.h"

#include <sys/mman.h>

namespace pdc::detail {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

}  // namespace

void* allocateLarge(std::size_t bytes) {
  const std::size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  void* p = ::operator new (whole, std::align_val_t{kHugePage});
  // Advice only: where it is not taken the memory is just slower to fill.
  (void)madvise(p, whole, MADV_HUGEPAGE);
  return p;
}

void freeLarge(void* p) noexcept { ::operator delete (p, std::align_val_t{kHugePage}); }

}  // namespace pdc::detail
