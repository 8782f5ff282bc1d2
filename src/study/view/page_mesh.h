#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// A mesh as its page holds it.
struct PageMesh {
  Vec3d corner{0, 0, 0};  ///< The lowest corner of the box of the faces, in world coordinates.
  Vec3d size{0, 0, 0};    ///< The box's sides.
  double step = 0;        ///< What coordinates are counted in, in world units.
  std::size_t quads = 0, lostFaces = 0;
  Buffer<std::uint32_t> positions;  ///< All x, then all y, then all z, in steps from the corner.
  Buffer<std::uint32_t> corners;    ///< Four vertices per quad, then three per triangle.

  [[nodiscard]] std::size_t vertices() const { return positions.size() / 3; }
  [[nodiscard]] std::size_t triangles() const { return 2 * quads + (corners.size() - 4 * quads) / 3; }
};

/// Coordinates are counted up to this along the longest side of the box.
inline constexpr std::uint32_t kPlaces = (std::uint32_t{1} << 20) - 1;

/// Faces with a NaN or infinite corner are left out; vertices that no face needs are in the box, wherever they were.
/// \throws Error for a mesh without other faces, with a face that names a vertex that does not exist.
[[nodiscard]] PageMesh pageMesh(const Mesh& mesh);

/// A number per vertex as a page holds it.
struct PageValues {
  std::string name;
  float lo = 0, hi = 0;          ///< The least and the greatest finite value; both 0 if there is none.
  std::size_t unknown = 0;       ///< How many are not finite.
  Buffer<std::uint32_t> places;  ///< From 0 at lo to kValuePlaces at hi; kUnknown for what is not finite.
};

inline constexpr std::uint32_t kValuePlaces = 65000, kUnknown = 65535;

[[nodiscard]] PageValues pageValues(std::string name, std::span<const float> values);

/// Red, green and blue of each vertex in one number, red highest. \param mesh has colours: see hasColours().
[[nodiscard]] Buffer<std::uint32_t> pageColours(const Mesh& mesh);

}  // namespace pdc::detail
