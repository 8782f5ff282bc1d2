#include "io/mesh/soup_builder.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "pdc/error.h"

namespace pdc::detail {

void SoupBuilder::addFace(std::span<const std::int64_t> corners) {
  if (corners.size() < 3) throw Error(fmt::format("face {} has {} corners", mFaces, corners.size()));
  for (const std::int64_t v : corners) {
    if (v < 0 || v > std::numeric_limits<std::uint32_t>::max())
      throw Error(fmt::format("face {} names vertex {}", mFaces, v));
    if (v > mLargestIndex) {
      mLargestIndex = v;
      mFaceOfLargestIndex = mFaces;
    }
  }
  const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
  if (corners.size() == 3) {
    mMesh.triangles.push_back({at(0), at(1), at(2)});
  } else if (corners.size() == 4) {
    mMesh.quads.push_back({at(0), at(1), at(2), at(3)});
  } else {
    mPolygon.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) mPolygon.push_back(at(i));
    mMesh.polygons.add(mPolygon);
  }
  ++mFaces;
}

Mesh SoupBuilder::finish() {
  if (mLargestIndex >= static_cast<std::int64_t>(vertices()))
    throw Error(fmt::format("face {} names vertex {}, but there are {} vertices", mFaceOfLargestIndex, mLargestIndex,
                            vertices()));
  return std::move(mMesh);
}

}  // namespace pdc::detail
