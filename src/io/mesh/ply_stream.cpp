#include "io/mesh/ply_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/parse/narrowing.h"
#include "mesh/faces.h"
#include "mesh/polygons/concave_quads.h"
#include "pdc/error.h"
#include "pdc/mesh/triangulate_polygons.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kBlock = 4096;

std::size_t bytesOf(PlyType type) {
  constexpr std::array<std::size_t, 9> kBytes{0, 1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

bool isIndices(const PlyProperty& p) { return p.isList() && p.name.starts_with("vertex_ind"); }

/// The bytes of one value of an element; nothing if that differs from one to the next.
std::optional<std::size_t> strideOf(const PlyElement& element) {
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    if (property.isList()) return std::nullopt;
    bytes += bytesOf(property.type);
  }
  return bytes;
}

bool hasFaces(const PlyElement& element) {
  return element.name == "face" || element.name == "tristrips" || element.name == "vertex" ||
         std::any_of(element.properties.begin(), element.properties.end(), isIndices);
}

const PlyProperty* coordinate(const PlyElement& vertices, std::string_view name) {
  const auto isNamed = [&](const PlyProperty& p) { return p.name == name; };
  const auto& all = vertices.properties;
  return std::count_if(all.begin(), all.end(), isNamed) == 1 ? &*std::find_if(all.begin(), all.end(), isNamed)
                                                             : nullptr;
}

}  // namespace

std::optional<PlyStream> PlyStream::open(const PlyHeader& header) {
  if (header.format == PlyFormat::kAscii) return std::nullopt;
  std::string_view vertices, rest = header.body;
  bool hasVertices = false;
  for (auto element = header.elements.begin(); element != header.elements.end(); ++element) {
    if (element->name == "face") {
      const bool read = hasVertices && std::any_of(element->properties.begin(), element->properties.end(), isIndices);
      if (!read || std::any_of(element + 1, header.elements.end(), hasFaces)) return std::nullopt;
      return PlyStream(header, vertices, rest);
    }
    const auto stride = strideOf(*element);
    const bool isVertices = element->name == "vertex";
    if (!stride || (isVertices && hasVertices) || (hasFaces(*element) && !isVertices)) return std::nullopt;
    if (*stride * element->count > rest.size()) return std::nullopt;
    if (isVertices) {
      for (const char* name : {"x", "y", "z"})
        if (coordinate(*element, name) == nullptr) return std::nullopt;
      vertices = rest.substr(0, *stride * element->count);
      hasVertices = true;
    }
    rest.remove_prefix(*stride * element->count);
  }
  return std::nullopt;
}

PlyStream::PlyStream(const PlyHeader& header, std::string_view vertices, std::string_view faces)
    : mVertices(vertices),
      mSwap((header.format == PlyFormat::kLittleEndian) != (std::endian::native == std::endian::little)),
      mOwn(header.isOwn),
      mNumbers(faces, mSwap) {
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      mVertexCount = element.count;
      for (const PlyProperty& p : element.properties) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (p.name != std::string_view("xyz").substr(axis, 1)) continue;
          mOffset[axis] = mVertexBytes;
          mType[axis] = p.type;
        }
        mVertexBytes += bytesOf(p.type);
      }
    }
    if (element.name == "face") mFaces = element;
  }
  mIndices = static_cast<std::size_t>(std::find_if(mFaces.properties.begin(), mFaces.properties.end(), isIndices) -
                                      mFaces.properties.begin());
  mFacesAreLast = header.elements.back().name == "face";
  const bool single = std::all_of(mType.begin(), mType.end(), [](PlyType t) { return t == PlyType::kFloat32; });
  const bool inRow = mOffset[1] == mOffset[0] + sizeof(float) && mOffset[2] == mOffset[1] + sizeof(float);
  mPlain = single && inRow && !mSwap;
  if (!single) chooseOrigin();
  mOrigin = header.origin.value_or(Vec3d{0, 0, 0}) + mShift;
}

void PlyStream::chooseOrigin() {
  Narrowing narrowing;
  for (std::size_t v = 0; v < mVertexCount; ++v) narrowing.include(coordinates(v));
  mShift = detail::chooseOrigin(narrowing);
}

Vec3d PlyStream::coordinates(std::size_t vertex) const {
  Vec3d p{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    p[axis] = BinaryNumbers(mVertices.substr(vertex * mVertexBytes + mOffset[i]), mSwap).next(mType[i]);
  }
  return p;
}

Vec3f PlyStream::position(std::size_t vertex) const {
  if (!mPlain) return vecCast<float>(coordinates(vertex) - mShift);
  Vec3f p;
  std::memcpy(&p, mVertices.data() + vertex * mVertexBytes + mOffset[0], sizeof(p));
  return p;
}

bool PlyStream::next(std::vector<std::array<Vec3f, 3>>& triangles) {
  triangles.clear();
  mTriangles.clear();
  mOthers = {};
  const std::size_t end = std::min(mFacesRead + kBlock, mFaces.count);
  if (mFacesRead == end) return false;
  for (; mFacesRead < end; ++mFacesRead) readFace();
  if (mOthers.empty()) {
    triangles.swap(mTriangles);
    return true;
  }
  const auto take = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) triangles.push_back(corners(mOthers, triangle(mOthers, i)));
  };
  if (!mOwn) turnConcaveQuads(mOthers);
  triangulatePolygons(mOthers);
  const std::size_t ofQuads = 2 * mOthers.quads.size();
  take(0, ofQuads);
  triangles.insert(triangles.end(), mTriangles.begin(), mTriangles.end());
  take(ofQuads, triangleCount(mOthers));
  return true;
}

void PlyStream::readFace() {
  for (std::size_t p = 0; p < mFaces.properties.size(); ++p) {
    if (p == mIndices) {
      readCorners();
      continue;
    }
    const PlyProperty& property = mFaces.properties[p];
    const double count = property.isList() ? mNumbers.next(property.countType) : 1;
    for (double i = 0; i < count; ++i) mNumbers.next(property.type);
  }
  addFace();
}

void PlyStream::readCorners() {
  const PlyProperty& indices = mFaces.properties[mIndices];
  mCorners.clear();
  const double count = mNumbers.next(indices.countType);
  if (count < 3)
    throw Error(fmt::format("face {} has {} corners, and needs 3 at least", mFacesRead, std::max(count, 0.0)));
  for (double k = 0; k < count; ++k) {
    const double index = mNumbers.next(indices.type);
    if (!(index >= 0 && index < static_cast<double>(mVertexCount) && index == std::floor(index)))
      throw Error(fmt::format("face {} names vertex {}, but there are {} vertices, numbered from 0", mFacesRead, index,
                              mVertexCount));
    mCorners.push_back(position(static_cast<std::size_t>(index)));
  }
}

void PlyStream::addFace() {
  if (mCorners.size() == 3) return mTriangles.push_back({mCorners[0], mCorners[1], mCorners[2]});
  const auto first = static_cast<std::uint32_t>(mOthers.positions.size());
  mOthers.positions.insert(mOthers.positions.end(), mCorners.begin(), mCorners.end());
  if (mCorners.size() == 4) return mOthers.quads.push_back({first, first + 1, first + 2, first + 3});
  Buffer<std::uint32_t> polygon(mCorners.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) polygon[i] = first + static_cast<std::uint32_t>(i);
  mOthers.polygons.add(polygon);
}

}  // namespace pdc::detail
