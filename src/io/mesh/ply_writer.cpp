#include "io/mesh/ply_writer.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/file/atomic_file.h"
#include "io/file/chunked_output.h"
#include "io/file/text_format.h"

namespace pdc::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it lies in memory");
static_assert(sizeof(Vec3f) == 12 && sizeof(Quad) == 16 && sizeof(Triangle) == 12);

/// About a megabyte of output per chunk: large enough for the system calls, small enough for the caches.
constexpr std::size_t kItemsPerChunk = 1 << 15;

std::string header(const Mesh& mesh, bool ascii) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment pdc\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}{}{}"
      "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
      ascii ? "ascii" : "binary_little_endian", mesh.positions.size(),
      mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n",
      mesh.confidence.empty() ? "" : "property float confidence\n", mesh.ranks.empty() ? "" : "property uchar rank\n",
      mesh.quads.size() + mesh.triangles.size(), plyIndexType(mesh.positions.size()));
}

/// Copies one value, if there is one per vertex. \returns where the next goes.
template <typename T>
char* put(const Buffer<T>& values, std::size_t i, char* to) {
  if (values.empty()) return to;
  std::memcpy(to, &values[i], sizeof(T));
  return to + sizeof(T);
}

void writeVertices(const Mesh& mesh, AtomicFile& file) {
  const std::size_t stride = sizeof(Vec3f) + (mesh.normals.empty() ? 0 : sizeof(Vec3f)) +
                             (mesh.confidence.empty() ? 0 : sizeof(float)) + (mesh.ranks.empty() ? 0 : 1);
  if (stride == sizeof(Vec3f)) {
    file.write(mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
    return;
  }
  writeChunked(file, mesh.positions.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    out.resize((end - begin) * stride);
    char* next = out.data();
    for (std::size_t i = begin; i < end; ++i) {
      next = put(mesh.positions, i, next);
      next = put(mesh.normals, i, next);
      next = put(mesh.confidence, i, next);
      next = put(mesh.ranks, i, next);
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

void writeVerticesAscii(const Mesh& mesh, AtomicFile& file) {
  writeChunked(file, mesh.positions.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin) * 8 * TextCursor::kMaxNumber);
    for (std::size_t i = begin; i < end; ++i) {
      putVector(text, mesh.positions[i]);
      if (!mesh.normals.empty()) {
        text.put(' ');
        putVector(text, mesh.normals[i]);
      }
      if (!mesh.confidence.empty()) {
        text.put(' ');
        text.put(mesh.confidence[i]);
      }
      if (!mesh.ranks.empty()) {
        text.put(' ');
        text.put(std::uint32_t{mesh.ranks[i]});
      }
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
