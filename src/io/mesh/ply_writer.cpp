#include "io/mesh/ply_writer.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "io/file/byte_output.h"
#include "io/file/chunked_output.h"
#include "io/file/text_format.h"
#include "io/mesh/corner_count.h"
#include "io/mesh/world_positions.h"
#include "io/parse/origin_text.h"
#include "io/parse/ply_columns.h"
#include "mesh/faces.h"

namespace pdc::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it lies in memory");
static_assert(sizeof(Vec3f) == 12 && sizeof(Quad) == 16 && sizeof(Triangle) == 12);

/// A chunk is about a megabyte: large enough for the system calls, small enough for the caches.
constexpr std::size_t kItemsPerChunk = 1 << 15;

/// Whether a byte holds the number of corners of every polygon.
bool areCountsBytes(const Polygons& polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i)
    if (polygons[i].size() > std::numeric_limits<std::uint8_t>::max()) return false;
  return true;
}

std::string header(const Mesh& mesh, const PlyCounts& counts, const MeshWriteOptions& options) {
  std::string properties;
  for (const VertexProperty& property : mesh.properties)
    for (const std::string& name : plyColumnNames(property))
      properties += fmt::format("property {} {}\n", plyTypeName(plyType(property)), name);
  const char* const real = plyTypeName(options.doublePrecision ? PlyType::kFloat64 : PlyType::kFloat32);
  return fmt::format(
      "ply\nformat {} 1.0\ncomment {}\n{}{}"
      "element vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n{}{}"
      "element face {}\nproperty list {} {} vertex_indices\nend_header\n",
      options.ascii ? "ascii" : "binary_little_endian", kOwnComment,
      options.doublePrecision ? "" : originLine(mesh, "comment "),
      commentLine(frameText(options.space, options.unit), "comment "), counts.vertices, real, real, real,
      mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n", properties, counts.faces,
      areCountsBytes(mesh.polygons) ? "uchar" : "uint", plyIndexType(counts.vertices));
}

/// An array with `stride` bytes for each vertex.
struct VertexBytes {
  const char* data;
  std::size_t stride;
};

/// \param world coordinates in place of positions, unless it is empty.
std::vector<VertexBytes> vertexBytes(const Mesh& mesh, const Buffer<Vec3d>& world) {
  std::vector<VertexBytes> arrays;
  const auto add = [&](const auto& values, std::size_t perVertex) {
    arrays.push_back({reinterpret_cast<const char*>(values.data()), perVertex * sizeof(values[0])});
  };
  if (world.empty()) {
    add(mesh.positions, 1);
  } else {
    add(world, 1);
  }
  if (!mesh.normals.empty()) add(mesh.normals, 1);
  for (const VertexProperty& property : mesh.properties)
    std::visit([&](const auto& values) { add(values, static_cast<std::size_t>(property.components)); },
               property.values);
  return arrays;
}

/// Copies the bytes of vertices [begin, end) to every `step` bytes. The common sizes are constants, which copies with
/// single instructions.
void scatter(const VertexBytes& from, std::size_t begin, std::size_t end, char* to, std::size_t step) {
  const auto copy = [&](auto stride) {
    const std::size_t bytes = stride;
    for (std::size_t i = begin; i < end; ++i, to += step) std::memcpy(to, from.data + i * bytes, bytes);
  };
  switch (from.stride) {
    case 1:
      return copy(std::integral_constant<std::size_t, 1>());
    case 4:
      return copy(std::integral_constant<std::size_t, 4>());
    case 12:
      return copy(std::integral_constant<std::size_t, 12>());
    default:
      return copy(from.stride);
  }
}

void writeVertices(const Mesh& mesh, const Buffer<Vec3d>& world, ByteOutput& file) {
  const std::vector<VertexBytes> arrays = vertexBytes(mesh, world);
  if (arrays.size() == 1) {
    file.write(arrays[0].data, mesh.positions.size() * arrays[0].stride);
    return;
  }
  std::size_t step = 0;
  for (const VertexBytes& array : arrays) step += array.stride;
  writeChunked(file, mesh.positions.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    out.resize((end - begin) * step);
    char* first = out.data();
    for (const VertexBytes& array : arrays) {
      scatter(array, begin, end, first, step);
      first += array.stride;
    }
  });
}

/// \tparam Count the type of a face's number of corners.
template <typename Count, typename Face>
char* putFace(const Face& face, char* to) {
  const auto count = static_cast<Count>(face.size());
  const std::size_t bytes = face.size() * sizeof(std::uint32_t);
  std::memcpy(to, &count, sizeof(Count));
  std::memcpy(to + sizeof(Count), face.data(), bytes);
  return to + sizeof(Count) + bytes;
}

template <typename Count, typename Faces>
void writeFaces(const Faces& faces, ByteOutput& file) {
  writeChunked(file, faces.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    out.resize((end - begin) * sizeof(Count) + cornerCount(faces, begin, end) * sizeof(std::uint32_t));
    char* next = out.data();
    for (std::size_t i = begin; i < end; ++i) next = putFace<Count>(faces[i], next);
  });
}

template <typename Count>
void writeAllFaces(const Mesh& mesh, ByteOutput& file) {
  writeFaces<Count>(mesh.quads, file);
  writeFaces<Count>(mesh.triangles, file);
  writeFaces<Count>(mesh.polygons, file);
}

template <typename Real>
void putVector(TextCursor& text, const Vec3<Real>& v) {
  text.put(v.x);
  text.put(' ');
  text.put(v.y);
  text.put(' ');
  text.put(v.z);
}

void putProperty(TextCursor& text, const VertexProperty& property, std::size_t i) {
  const auto components = static_cast<std::size_t>(property.components);
  std::visit(
      [&](const auto& values) {
        for (std::size_t k = i * components; k < (i + 1) * components; ++k) {
          text.put(' ');
          text.put(values[k]);
        }
      },
      property.values);
}

void writeVerticesAscii(const Mesh& mesh, const Buffer<Vec3d>& world, ByteOutput& file) {
  std::size_t numbers = 6;
  for (const VertexProperty& property : mesh.properties) numbers += static_cast<std::size_t>(property.components);
  writeChunked(file, mesh.positions.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin) * numbers * TextCursor::kMaxNumber);
    for (std::size_t i = begin; i < end; ++i) {
      if (world.empty()) {
        putVector(text, mesh.positions[i]);
      } else {
        putVector(text, world[i]);
      }
      if (!mesh.normals.empty()) {
        text.put(' ');
        putVector(text, mesh.normals[i]);
      }
      for (const VertexProperty& property : mesh.properties) putProperty(text, property, i);
      text.put('\n');
    }
    text.finish();
  });
}

template <typename Faces>
void writeFacesAscii(const Faces& faces, ByteOutput& file) {
  writeChunked(file, faces.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin + cornerCount(faces, begin, end)) * TextCursor::kMaxNumber);
    for (std::size_t i = begin; i < end; ++i) {
      text.put(faces[i].size());
      for (const std::uint32_t v : faces[i]) {
        text.put(' ');
        text.put(v);
      }
      text.put('\n');
    }
    text.finish();
  });
}

}  // namespace

const char* plyIndexType(std::size_t vertices) {
  constexpr std::size_t kIntIndices = std::size_t{1} << 31;
  return vertices <= kIntIndices ? "int" : "uint";
}

void writePlyHeader(const Mesh& mesh, const PlyCounts& counts, ByteOutput& file, const MeshWriteOptions& options) {
  checkPlyNames(mesh);
  const std::string text = header(mesh, counts, options);
  file.write(text.data(), text.size());
}

void writePlyVertices(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options) {
  const Buffer<Vec3d> world = options.doublePrecision ? worldPositions(mesh) : Buffer<Vec3d>();
  if (options.ascii) {
    writeVerticesAscii(mesh, world, file);
  } else {
    writeVertices(mesh, world, file);
  }
}

void writePlyFaces(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options) {
  if (options.ascii) {
    writeFacesAscii(mesh.quads, file);
    writeFacesAscii(mesh.triangles, file);
    writeFacesAscii(mesh.polygons, file);
  } else if (areCountsBytes(mesh.polygons)) {
    writeAllFaces<std::uint8_t>(mesh, file);
  } else {
    writeAllFaces<std::uint32_t>(mesh, file);
  }
}

void writePly(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options) {
  writePlyHeader(mesh, {mesh.positions.size(), faceCount(mesh)}, file, options);
  writePlyVertices(mesh, file, options);
  writePlyFaces(mesh, file, options);
}

}  // namespace pdc::detail
