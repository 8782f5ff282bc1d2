#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace pdc {

/// Fresh memory is dear: the system clears it page by page, which can take as long as filling it with a mesh. So large
/// arrays lie in huge pages where the system has them, and up to kKeptMemory bytes of what they leave behind are kept
/// for the next ones.
inline constexpr std::size_t kKeptMemory = std::size_t{128} << 20;

/// Bytes that are kept at present.
[[nodiscard]] std::size_t keptMemory();
/// Gives all of the memory back to the system that large arrays have left behind. Safe at any time, from any thread.
void releaseMemory();

namespace detail {
void* allocateLarge(std::size_t bytes);
void freeLarge(void* p, std::size_t bytes) noexcept;
inline constexpr std::size_t kLargeBytes = std::size_t{1} << 19;
}  // namespace detail

/// An allocator that leaves elements that are copied byte by byte uninitialised on resize, whatever their members'
/// initial values, so that large arrays are first touched by the threads that fill them.
template <typename T>
struct UninitializedAllocator {
  using value_type = T;

  UninitializedAllocator() = default;
  template <typename U>
  explicit UninitializedAllocator(const UninitializedAllocator<U>&) noexcept {}

  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = n * sizeof(T);
    return static_cast<T*>(bytes >= detail::kLargeBytes ? detail::allocateLarge(bytes) : ::operator new(bytes));
  }
  void deallocate(T* p, std::size_t n) noexcept {
    n * sizeof(T) >= detail::kLargeBytes ? detail::freeLarge(p, n * sizeof(T)) : ::operator delete(p);
  }

  template <typename U, typename... Args>
  void construct(U* p, Args&&... args) {
    if constexpr (sizeof...(Args) != 0 || !std::is_trivially_copyable_v<U>)
      ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(const UninitializedAllocator&, const UninitializedAllocator&) { return true; }
};

/// A std::vector whose resize() does not clear.
template <typename T>
using Buffer = std::vector<T, UninitializedAllocator<T>>;

}  // namespace pdc
