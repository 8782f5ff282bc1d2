#pragma once

#include <cstring>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// Four floats in a vector register, with the arithmetic of the compiler's vector extension, which gives the same bits
/// on every processor.
using Float4 = float __attribute__((vector_size(16)));

inline Float4 loadFloat4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(Float4 v, float* p) { std::memcpy(p, &v, sizeof v); }
inline Float4 float4(const Vec3f& v) { return Float4{v.x, v.y, v.z, 0.0F}; }
inline Vec3f vec3(Float4 v) { return {v[0], v[1], v[2]}; }
/// The dot product of the first three entries.
inline float dot3(Float4 a, Float4 b) {
  const Float4 p = a * b;
  return p[0] + p[1] + p[2];
}

}  // namespace pdc::detail
