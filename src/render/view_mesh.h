#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pdc/mesh/mesh.h"
#include "pdc/render/camera.h"

namespace pdc::detail {

/// A mesh as the picture needs it. Coordinates are pixels: x from the left, y from the bottom, z towards the viewer
/// from the camera's centre. Triangles without finite corners or without a direction are left out.
struct ViewMesh {
  Buffer<Vec3f> positions;  ///< The mesh's, and one more, because RayScene reads past the end.
  Buffer<Triangle> triangles;
  Buffer<Vec3f> faceNormals;                   ///< A unit vector per triangle.
  Buffer<std::array<Vec3f, 3>> cornerNormals;  ///< Unit vectors; smoothed, but not over creases.
  Buffer<std::uint8_t> drawnEdges;             ///< Bit i is set if the edge opposite corner i is one of the mesh's.
};

/// Faces that meet at more than this share no normal, in degrees. Below it lie the turns of curved surfaces of a few
/// dozen voxels, above it those of parts that people call sharp.
inline constexpr double kCreaseDegrees = 30;

/// \throws Error if a face names a vertex that does not exist.
[[nodiscard]] ViewMesh viewMesh(const Mesh& mesh, const Camera& camera, int width, int height);

/// The corner normals of triangles with these unit normals and areas: at each corner the mean, weighted by area, of the
/// normals around it that are within kCreaseDegrees of the triangle's own; at vertices with very many triangles up to a
/// few degrees.
[[nodiscard]] Buffer<std::array<Vec3f, 3>> smoothNormals(std::span<const Triangle> triangles,
                                                         std::span<const Vec3f> faceNormals,
                                                         std::span<const float> areas, std::size_t vertexCount);

}  // namespace pdc::detail
