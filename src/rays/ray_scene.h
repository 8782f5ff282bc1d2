#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// What a ray meets first.
struct RayHit {
  bool found = false;
  float distance = 0;
  std::uint32_t triangle = 0;
  float u = 0, v = 0;  ///< Weights of the triangle's second and third corner.
};

/// Triangles that rays can be shot at, from any number of threads at once.
class RayScene {
 public:
  /// \param positions, triangles must outlive the scene; the last position is only there to be read past the others.
  /// \throws Error if the ray caster has no memory or no processor that it knows.
  RayScene(std::span<const Vec3f> positions, std::span<const Triangle> triangles);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Of all triangles met at one distance, any; the same for the same scene and ray.
  [[nodiscard]] RayHit hit(const Vec3f& origin, const Vec3f& direction) const;
  /// Whether anything lies on the ray nearer than `reach`, in lengths of `direction`.
  [[nodiscard]] bool blocked(const Vec3f& origin, const Vec3f& direction, float reach) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> mImpl;
};

}  // namespace pdc::detail
