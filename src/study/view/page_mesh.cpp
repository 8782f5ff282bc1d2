#include "study/view/page_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "pdc/error.h"
#include "pdc/math/box.h"

namespace pdc::detail {
namespace {

/// Appends the corners of faces whose corners are all finite and grows the box to hold them. \returns how many faces
/// were left out.
template <typename Face>
std::size_t append(const Buffer<Face>& faces, const Mesh& mesh, BasicBox<double>& box, Buffer<std::uint32_t>& corners) {
  std::size_t lost = 0;
  for (const Face& face : faces) {
    if (!std::all_of(face.begin(), face.end(), [&](std::uint32_t v) { return isFinite(mesh.positions[v]); })) {
      ++lost;
      continue;
    }
    corners.insert(corners.end(), face.begin(), face.end());
    for (const std::uint32_t v : face) box.include(vecCast<double>(mesh.positions[v]));
  }
  return lost;
}

/// \returns 0 for NaN.
std::uint32_t counted(double steps, std::uint32_t most) {
  return steps >= 0 ? static_cast<std::uint32_t>(std::min(std::round(steps), double(most))) : 0;
}

}  // namespace

PageMesh pageMesh(const Mesh& mesh) {
  checkIndices(mesh);
  PageMesh page;
  auto box = BasicBox<double>::empty();
  page.lostFaces = append(mesh.quads, mesh, box, page.corners);
  page.quads = page.corners.size() / 4;
  page.lostFaces += append(mesh.triangles, mesh, box, page.corners);
  if (page.corners.empty()) throw Error("the mesh has no faces with finite corners, so there is nothing to show");
  page.corner = mesh.origin + box.lo;
  page.size = box.hi - box.lo;
  const double longest = std::max({page.size.x, page.size.y, page.size.z});
  page.step = longest / kPlaces;
  const std::size_t vertices = mesh.positions.size();
  page.positions.resize(3 * vertices);
  const double perUnit = longest > 0 ? kPlaces / longest : 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < vertices; ++i) {
      const auto k = static_cast<int>(axis);
      page.positions[axis * vertices + i] = counted((double(mesh.positions[i][k]) - box.lo[k]) * perUnit, kPlaces);
    }
  return page;
}

PageValues pageValues(std::string name, std::span<const float> values) {
  PageValues page{.name = std::move(name), .places = {}};
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float lo = kInfinity, hi = -kInfinity;
  for (const float v : values) {
    if (!std::isfinite(v)) {
      ++page.unknown;
      continue;
    }
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  if (lo <= hi) std::tie(page.lo, page.hi) = std::pair(lo, hi);
  const double range = double(page.hi) - double(page.lo);
  page.places.reserve(values.size());
  for (const float v : values)
    page.places.push_back(!std::isfinite(v) ? kUnknown
                          : range > 0 ? counted((double(v) - double(page.lo)) / range * kValuePlaces, kValuePlaces)
                                      : 0);
  return page;
}

Buffer<std::uint32_t> pageColours(const Mesh& mesh) {
  Buffer<std::uint32_t> colours(mesh.positions.size(), 0);
  for (const char* const name : {"red", "green", "blue"}) {
    const auto bytes = mesh.values<std::uint8_t>(name);
    for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = colours[i] << 8 | bytes[i];
  }
  return colours;
}

}  // namespace pdc::detail
