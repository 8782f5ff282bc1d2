#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace pdc {

// Fresh memory is dear: the system clears it page by page, which can take as long as filling it with a mesh. So arrays
// of half a mebibyte and more lie in huge pages where the system has them, and what they leave behind is kept for the
// next ones. The kept memory is one pool for the whole process, which all threads share.

/// The most bytes that are kept. The oldest are given back for newer ones.
inline constexpr std::size_t kKeptMemory = std::size_t{128} << 20;

/// How many bytes are kept at present: 0 to kKeptMemory. Another thread may change it at any time.
[[nodiscard]] std::size_t keptMemory();
/// Gives all kept memory back to the system; arrays in use stay as they are. Safe at any time, from any thread.
void releaseMemory();

namespace detail {
void* allocateLarge(std::size_t bytes);
void freeLarge(void* p, std::size_t bytes) noexcept;
inline constexpr std::size_t kLargeBytes = std::size_t{1} << 19;
}  // namespace detail

/// An allocator that leaves elements that are copied byte by byte uninitialised on resize, whatever their members'
/// initial values, so that large arrays are first touched by the threads that fill them. Has no state: all are equal.
/// Any thread may free what another has allocated. Throws std::bad_alloc where memory is out, and
/// std::bad_array_new_length, which is one, for more elements than can be addressed.
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

/// A std::vector whose resize() does not clear: new elements hold anything until they are written. Guarantees to
/// threads are those of std::vector.
template <typename T>
using Buffer = std::vector<T, UninitializedAllocator<T>>;

}  // namespace pdc
