#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Where a ray first meets a triangle.
struct RayHit {
  bool found = false;          ///< The rest is zero if not.
  float distance = 0;          ///< From the ray's origin, in lengths of its direction.
  std::uint32_t triangle = 0;  ///< Index of the triangle.
  float u = 0, v = 0;          ///< Barycentric weights of the triangle's second and third corner.
};

/// Triangles that rays can be cast at, from any number of threads at once (Embree, single precision, in its robust
/// mode: no ray slips through between two triangles that share an edge). Both faces of a triangle are met.
class RayScene {
 public:
  /// The spans must outlive the scene, and triangles name existing positions, which is not checked.
  /// \param positions the last one belongs to no triangle: Embree reads past the others.
  /// \throws Error if Embree does not know the processor or fails, std::bad_alloc if it has no memory.
  RayScene(std::span<const Vec3f> positions, std::span<const Triangle> triangles);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// The first triangle on the ray from `origin` along `direction`, which need not be a unit vector. Of several at one
  /// distance it is any, but the same for the same scene and ray.
  [[nodiscard]] RayHit hit(const Vec3f& origin, const Vec3f& direction) const;
  /// Whether a triangle lies on the ray nearer than `reach` lengths of `direction`.
  [[nodiscard]] bool blocked(const Vec3f& origin, const Vec3f& direction, float reach) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> mImpl;
};

}  // namespace pdc::detail
