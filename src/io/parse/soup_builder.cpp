#include "io/parse/soup_builder.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "pdc/error.h"

namespace pdc::detail {
namespace {

std::string placeOf(std::size_t face, std::size_t line) {
  return line > 0 ? fmt::format("line {}: a face", line) : fmt::format("face {}", face);
}

}  // namespace

Error SoupBuilder::missingVertex(const Corner& corner, const std::string& limit) const {
  return Error(fmt::format("{} names vertex {}, but {}", placeOf(corner.face, corner.line),
                           corner.vertex + mFirstNumber, limit));
}

void SoupBuilder::addFace(std::span<const std::int64_t> corners, std::size_t line) {
  if (corners.size() < 3)
    throw Error(fmt::format("{} has {} corners, and needs 3 at least", placeOf(mFaces, line), corners.size()));
  for (const std::int64_t v : corners) {
    if (v < 0) throw missingVertex({v, mFaces, line}, fmt::format("vertices are numbered from {}", mFirstNumber));
    if (v > std::numeric_limits<std::uint32_t>::max())
      throw missingVertex({v, mFaces, line}, fmt::format("a mesh has at most {} vertices", std::uint64_t{1} << 32));
    if (v > mLargest.vertex) mLargest = {v, mFaces, line};
  }
  Mesh& mesh = mParsed.mesh;
  const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
  if (corners.size() == 3) {
    mesh.triangles.push_back({at(0), at(1), at(2)});
  } else if (corners.size() == 4) {
    mesh.quads.push_back({at(0), at(1), at(2), at(3)});
  } else {
    mPolygon.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) mPolygon.push_back(at(i));
    mesh.polygons.add(mPolygon);
  }
  ++mFaces;
}

ParsedMesh SoupBuilder::finish(const std::optional<Vec3d>& origin) {
  if (mLargest.vertex >= static_cast<std::int64_t>(vertices()))
    throw missingVertex(mLargest, fmt::format("there are {} vertices, numbered from {}", vertices(), mFirstNumber));
  mParsed.mesh.origin = origin.value_or(Vec3d{0, 0, 0}) + mShift;
  return std::move(mParsed);
}

}  // namespace pdc::detail
