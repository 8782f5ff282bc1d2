#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdc/mesh/buffer.h"

namespace pdc {

/// Faces of three or more corners each, one after the other in one array.
struct Polygons {
  Buffer<std::uint32_t> corners;  ///< Vertices; those of polygon i from number starts[i] to the next start or the end.
  Buffer<std::size_t> starts;     ///< One per polygon, from 0 on.

  [[nodiscard]] std::size_t size() const { return starts.size(); }
  [[nodiscard]] bool empty() const { return starts.empty(); }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {corners.data() + starts[i], corners.data() + (i + 1 < starts.size() ? starts[i + 1] : corners.size())};
  }
  void add(std::span<const std::uint32_t> polygon) {
    starts.push_back(corners.size());
    corners.insert(corners.end(), polygon.begin(), polygon.end());
  }
  friend bool operator==(const Polygons&, const Polygons&) = default;
};

}  // namespace pdc
