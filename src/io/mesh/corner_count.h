#pragma once

#include <cstddef>
#include <tuple>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// How many corners faces [begin, end) have together; begin < end.
template <typename Face>
std::size_t cornerCount(const Buffer<Face>& /*faces*/, std::size_t begin, std::size_t end) {
  return (end - begin) * std::tuple_size_v<Face>;
}
inline std::size_t cornerCount(const Polygons& polygons, std::size_t begin, std::size_t end) {
  return (end < polygons.size() ? polygons.starts[end] : polygons.corners.size()) - polygons.starts[begin];
}

}  // namespace pdc::detail
