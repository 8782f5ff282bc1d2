#include "pdc/mesh/buffer.h"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <mutex>
#include <new>
#include <vector>

namespace pdc {
namespace detail {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// What is allocated for so many bytes: sizes go in steps of an eighth at most, so that arrays of about one size can
/// take each other's place.
std::size_t allocationSize(std::size_t bytes) {
  const std::size_t step = std::max(kHugePage, std::bit_floor(bytes) / 8);
  return (bytes + step - 1) / step * step;
}

void giveBack(void* p) { ::operator delete (p, std::align_val_t{kHugePage}); }

/// Freed allocations, the oldest first.
class KeptAllocations {
 public:
  /// \returns memory of exactly that size, or null.
  void* take(std::size_t size) {
    const std::lock_guard lock(mMutex);
    const auto it = std::find_if(mAllocations.rbegin(), mAllocations.rend(),
                                 [size](const Allocation& a) { return a.size == size; });
    if (it == mAllocations.rend()) return nullptr;
    void* const memory = it->memory;
    mBytes -= size;
    mAllocations.erase(std::next(it).base());
    return memory;
  }
  /// Keeps an allocation and gives back the oldest ones for which there is no room then. \returns false if there is
  /// none for it.
  bool keep(void* memory, std::size_t size) noexcept try {
    if (size > kKeptMemory) return false;
    const std::lock_guard lock(mMutex);
    mAllocations.push_back({memory, size});
    mBytes += size;
    giveBackDownTo(kKeptMemory);
    return true;
  } catch (...) {
    return false;
  }
  void clear() {
    const std::lock_guard lock(mMutex);
    giveBackDownTo(0);
  }
  std::size_t bytes() {
    const std::lock_guard lock(mMutex);
    return mBytes;
  }

 private:
  struct Allocation {
    void* memory;
    std::size_t size;
  };

  void giveBackDownTo(std::size_t most) {
    auto it = mAllocations.begin();
    for (; mBytes > most; ++it) {
      giveBack(it->memory);
      mBytes -= it->size;
    }
    mAllocations.erase(mAllocations.begin(), it);
  }

  std::mutex mMutex;
  std::vector<Allocation> mAllocations;
  std::size_t mBytes = 0;
};

/// Never destroyed: arrays may be freed after everything else.
KeptAllocations& kept() {
  static auto* const allocations = new KeptAllocations;
  return *allocations;
}

}  // namespace

void* allocateLarge(std::size_t bytes) {
  const std::size_t size = allocationSize(bytes);
  if (void* const p = kept().take(size)) return p;
  void* const p = ::operator new (size, std::align_val_t{kHugePage});
  // Advice only: where it is not taken the memory is just slower to fill.
  (void)madvise(p, size, MADV_HUGEPAGE);
  return p;
}

void freeLarge(void* p, std::size_t bytes) noexcept {
  if (!kept().keep(p, allocationSize(bytes))) giveBack(p);
}

}  // namespace detail

std::size_t keptMemory() { return detail::kept().bytes(); }

void releaseMemory() { detail::kept().clear(); }

}  // namespace pdc
