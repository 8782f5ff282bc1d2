#include "mesh/components.h"

#include <numeric>

#include "mesh/faces.h"

namespace pdc::detail {
namespace {

/// Union-find: each vertex names one of its piece with a lower number, or itself.
class Pieces {
 public:
  explicit Pieces(std::size_t vertices) : mLower(vertices) { std::iota(mLower.begin(), mLower.end(), 0u); }

  std::uint32_t find(std::uint32_t v) {
    while (mLower[v] != v) {
      mLower[v] = mLower[mLower[v]];
      v = mLower[v];
    }
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    (a < b ? mLower[b] : mLower[a]) = a < b ? a : b;
  }

 private:
  std::vector<std::uint32_t> mLower;
};

}  // namespace

std::vector<std::uint32_t> componentSizes(const Mesh& mesh) {
  Pieces pieces(mesh.positions.size());
  for (std::size_t i = 0; i < faceCount(mesh); ++i) {
    const auto corners = face(mesh, i);
    for (std::size_t k = 1; k < corners.size(); ++k) pieces.join(corners[0], corners[k]);
  }
  std::vector<std::uint32_t> sizes, number(mesh.positions.size());
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const std::uint32_t first = pieces.find(v);
    if (first == v) {
      number[v] = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(0);
    }
    ++sizes[number[first]];
  }
  return sizes;
}

}  // namespace pdc::detail
