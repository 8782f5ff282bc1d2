#include "io/mesh/ply_writer.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "io/file/atomic_file.h"
#include "io/file/chunked_output.h"
#include "io/file/text_format.h"
#include "io/mesh/ply_columns.h"

namespace pdc::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it lies in memory");
static_assert(sizeof(Vec3f) == 12 && sizeof(Quad) == 16 && sizeof(Triangle) == 12);

/// About a megabyte of output per chunk: large enough for the system calls, small enough for the caches.
constexpr std::size_t kItemsPerChunk = 1 << 15;

std::string header(const Mesh& mesh, bool ascii) {
  std::string properties;
  for (const VertexProperty& property : mesh.properties)
    for (const std::string& name : plyColumnNames(property))
      properties += fmt::format("property {} {}\n", plyTypeName(plyType(property)), name);
  return fmt::format(
      "ply\nformat {} 1.0\ncomment pdc\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}{}"
      "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
      ascii ? "ascii" : "binary_little_endian", mesh.positions.size(),
      mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n", properties,
      mesh.quads.size() + mesh.triangles.size(), plyIndexType(mesh.positions.size()));
}

/// An array with `stride` bytes for each vertex.
struct VertexBytes {
  const char* data;
  std::size_t stride;
};

std::vector<VertexBytes> vertexBytes(const Mesh& mesh) {
  std::vector<VertexBytes> arrays;
  const auto add = [&](const auto& values, std::size_t perVertex) {
    arrays.push_back({reinterpret_cast<const char*>(values.data()), perVertex * sizeof(values[0])});
  };
  add(mesh.positions, 1);
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

void writeVertices(const Mesh& mesh, AtomicFile& file) {
  const std::vector<VertexBytes> arrays = vertexBytes(mesh);
  if (arrays.size() == 1) {
    file.write(mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
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

template <typename Face>
void writeFaces(const Buffer<Face>& faces, AtomicFile& file) {
  writeChunked(file, faces.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    constexpr std::size_t kStride = 1 + sizeof(Face);
    out.resize((end - begin) * kStride);
    char* next = out.data();
    for (std::size_t i = begin; i < end; ++i, next += kStride) {
      *next = static_cast<char>(faces[i].size());
      std::memcpy(next + 1, faces[i].data(), sizeof(Face));
    }
  });
}

void putVector(TextCursor& text, const Vec3f& v) {
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

void writeVerticesAscii(const Mesh& mesh, AtomicFile& file) {
  std::size_t numbers = 6;
  for (const VertexProperty& property : mesh.properties) numbers += static_cast<std::size_t>(property.components);
  writeChunked(file, mesh.positions.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin) * numbers * TextCursor::kMaxNumber);
    for (std::size_t i = begin; i < end; ++i) {
      putVector(text, mesh.positions[i]);
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

template <typename Face>
void writeFacesAscii(const Buffer<Face>& faces, AtomicFile& file) {
  writeChunked(file, faces.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin) * (1 + std::tuple_size_v<Face>)*TextCursor::kMaxNumber);
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

void writePly(const Mesh& mesh, AtomicFile& file, bool ascii) {
  checkPlyNames(mesh);
  const std::string text = header(mesh, ascii);
  file.write(text.data(), text.size());
  if (ascii) {
    writeVerticesAscii(mesh, file);
    writeFacesAscii(mesh.quads, file);
    writeFacesAscii(mesh.triangles, file);
  } else {
    writeVertices(mesh, file);
    writeFaces(mesh.quads, file);
    writeFaces(mesh.triangles, file);
  }
}

}  // namespace pdc::detail
