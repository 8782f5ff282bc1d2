#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "pdc/math/vec3.h"

namespace pdc {

namespace detail {
/// Memory for large arrays, in huge pages where the system has them: half of the time of filling fresh memory is the
/// system's for handing it out page by page.
void* allocateLarge(std::size_t bytes);
void freeLarge(void* p) noexcept;
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
    n * sizeof(T) >= detail::kLargeBytes ? detail::freeLarge(p) : ::operator delete(p);
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

using Quad = std::array<std::uint32_t, 4>;
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed surface: vertices, and quads or triangles or both.
///
/// Positions are world coordinates. Faces are counter-clockwise seen from outside. A quad (v0, v1, v2, v3) stands for
/// the triangles (v0, v1, v2) and (v0, v2, v3): its first corner fixes the diagonal.
struct Mesh {
  Buffer<Vec3f> positions;
  Buffer<Vec3f> normals;       ///< Empty, or one unit vector per vertex.
  Buffer<float> confidence;    ///< Empty, or one number in [0, 1] per vertex; see ContourOptions.
  Buffer<std::uint8_t> ranks;  ///< Empty, or one per vertex: 1 on a flat part, 2 on an edge, 3 at a corner.
  Buffer<Quad> quads;
  Buffer<Triangle> triangles;

  [[nodiscard]] bool empty() const { return quads.empty() && triangles.empty(); }
};

}  // namespace pdc
