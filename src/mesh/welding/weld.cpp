#include "mesh/welding/weld.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// Numbers positions in the order of their first appearance. Open addressing, at most half full.
class PositionNumbers {
 public:
  PositionNumbers(std::size_t most, Buffer<Vec3f>& positions)
      : mPositions(positions), mSlots(std::bit_ceil(2 * most + 1), kEmpty), mMask(mSlots.size() - 1) {}

  std::uint32_t operator()(const Vec3f& position) {
    const Bits bits = bitsOf(position);
    std::size_t slot = hash(bits) & mMask;
    while (mSlots[slot] != kEmpty && bitsOf(mPositions[mSlots[slot]]) != bits) slot = (slot + 1) & mMask;
    if (mSlots[slot] == kEmpty) {
      mSlots[slot] = static_cast<std::uint32_t>(mPositions.size());
      mPositions.push_back(position);
    }
    return mSlots[slot];
  }

 private:
  using Bits = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

  static std::uint32_t bitsOf(float v) { return std::bit_cast<std::uint32_t>(v == 0 ? 0.0f : v); }
  static Bits bitsOf(const Vec3f& p) { return {bitsOf(p.x), bitsOf(p.y), bitsOf(p.z)}; }

  /// Multiplications carry upwards only, so each is followed by a shift downwards.
  static std::uint64_t hash(const Bits& bits) {
    constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;  // 2^64 / golden ratio
    std::uint64_t h = 0;
    for (const std::uint32_t b : bits) {
      h = (h ^ b) * kOdd;
      h ^= h >> 32;
    }
    return h;
  }

  Buffer<Vec3f>& mPositions;
  std::vector<std::uint32_t> mSlots;
  std::size_t mMask;
};

}  // namespace

Mesh weld(const Buffer<Vec3f>& corners) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - 1;
  if (corners.size() > kMost) throw Error(fmt::format("{} corners; the limit is {}", corners.size(), kMost));
  Mesh mesh;
  PositionNumbers numbers(corners.size(), mesh.positions);
  mesh.triangles.resize(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) mesh.triangles[i / 3][i % 3] = numbers(corners[i]);
  return mesh;
}

}  // namespace pdc::detail
