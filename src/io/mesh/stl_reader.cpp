#include "io/mesh/stl_reader.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "io/file/suffix.h"
#include "io/file/text_scanner.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;

std::size_t announcedFacets(std::string_view bytes) {
  std::uint32_t facets = 0;
  if (bytes.size() >= kHeaderBytes) std::memcpy(&facets, bytes.data() + kHeaderBytes - sizeof(facets), sizeof(facets));
  return facets;
}

/// Three corners per facet, after its normal.
Buffer<Vec3f> binaryCorners(std::string_view bytes) {
  const std::size_t facets = announcedFacets(bytes);
  Buffer<Vec3f> corners(3 * facets);
  tbb::parallel_for(std::size_t{0}, facets, [&](std::size_t i) {
    std::memcpy(&corners[3 * i], bytes.data() + kHeaderBytes + i * kFacetBytes + sizeof(Vec3f), 3 * sizeof(Vec3f));
  });
  return corners;
}

Buffer<Vec3f> textCorners(std::string_view text) {
  TextScanner scanner(text, '\0');
  Buffer<Vec3f> corners;
  bool ended = false;
  while (scanner.nextLine()) {
    const std::string keyword = lowerCase(scanner.word());
    ended = keyword == "endsolid";
    if (keyword == "vertex") {
      const auto x = scanner.number<float>(), y = scanner.number<float>(), z = scanner.number<float>();
      if (!x || !y || !z) throw Error(fmt::format("line {}: malformed vertex", scanner.lineNumber()));
      corners.push_back({*x, *y, *z});
    } else if ((keyword == "facet" || keyword == "endfacet" || ended) && corners.size() % 3 != 0) {
      throw Error(fmt::format("line {}: a facet that is not a triangle", scanner.lineNumber()));
    }
  }
  if (!ended) throw Error(fmt::format("ends after line {} without endsolid", scanner.lineNumber()));
  return corners;
}

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

Mesh weld(const Buffer<Vec3f>& corners) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - 1;
  if (corners.size() > kMost) throw Error(fmt::format("{} corners; the limit is {}", corners.size(), kMost));
  Mesh mesh;
  PositionNumbers numbers(corners.size(), mesh.positions);
  mesh.triangles.resize(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) mesh.triangles[i / 3][i % 3] = numbers(corners[i]);
  return mesh;
}

}  // namespace

Mesh readStl(std::string_view bytes) {
  const std::size_t binarySize = kHeaderBytes + announcedFacets(bytes) * kFacetBytes;
  if (bytes.size() == binarySize) return weld(binaryCorners(bytes));
  if (lowerCase(bytes.substr(0, 5)) == "solid") return weld(textCorners(bytes));
  if (bytes.size() < kHeaderBytes) throw Error(fmt::format("{} bytes are too few for an STL file", bytes.size()));
  throw Error(
      fmt::format("{} facets make {} bytes, but the file has {}", announcedFacets(bytes), binarySize, bytes.size()));
}

}  // namespace pdc::detail
