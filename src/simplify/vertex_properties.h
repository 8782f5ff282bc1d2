#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// The properties of a mesh's vertices while its edges are collapsed.
class InterpolatedProperties {
 public:
  explicit InterpolatedProperties(const Mesh& mesh) : mProperties(mesh.properties) {}

  /// Gives vertex a what lies between it and b, at `share` of the way; whole numbers are rounded to nearest. Calls for
  /// different a may run at the same time, if none reads another's a.
  void blend(std::uint32_t a, std::uint32_t b, double share);
  /// What some vertices have, in the order given.
  [[nodiscard]] std::vector<VertexProperty> of(std::span<const std::uint32_t> vertices) const;

 private:
  std::vector<VertexProperty> mProperties;
};

}  // namespace pdc::detail
