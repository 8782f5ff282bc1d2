#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

inline constexpr std::uint32_t kNoHub = 0xffffffff;

/// Vertices at which so many triangles meet that trying all pairs of them would take long, with the triangles there.
/// Each triangle is at one hub at most, of several at that with the most triangles.
struct Hubs {
  static constexpr std::uint32_t kMany = 64;  ///< The fewest triangles that make a vertex a hub.

  std::vector<std::uint32_t> vertices;
  std::vector<Buffer<std::uint32_t>> triangles;  ///< Numbers, for each hub.
  Buffer<std::uint32_t> of;  ///< For each triangle searched, in order, the index of its hub or kNoHub. Empty: no hubs.
};

/// Finds the hubs among triangles of one mesh, several times.
class HubSearch {
 public:
  explicit HubSearch(const Mesh& mesh) : mMesh(mesh), mCounts(mesh.positions.size(), 0) {}

  /// \param triangles their numbers, see faces.h. \param besides a vertex that is none of the hubs; kNoHub: all may be.
  /// \param fits whether this triangle can be at this hub.
  [[nodiscard]] Hubs run(std::span<const std::uint32_t> triangles, std::uint32_t besides,
                         const std::function<bool(std::uint32_t triangle, std::uint32_t hub)>& fits);

 private:
  const Mesh& mMesh;
  Buffer<std::uint32_t> mCounts;  ///< Triangles at each vertex; zero between searches.
};

}  // namespace pdc::detail
