#include "io/mesh/obj_writer.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "io/file/atomic_file.h"
#include "io/file/chunked_output.h"
#include "io/file/text_format.h"
#include "io/mesh/corner_count.h"
#include "io/mesh/world_positions.h"
#include "io/parse/origin_text.h"

namespace pdc::detail {
namespace {

/// A chunk is about a megabyte of text.
constexpr std::size_t kItemsPerChunk = 1 << 15;

template <typename Real>
void writeVectors(const Buffer<Vec3<Real>>& vectors, bool normals, AtomicFile& file) {
  writeChunked(file, vectors.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin) * 4 * TextCursor::kMaxNumber);
    for (std::size_t i = begin; i < end; ++i) {
      text.put('v');
      if (normals) text.put('n');
      for (int axis = 0; axis < 3; ++axis) {
        text.put(' ');
        text.put(vectors[i][axis]);
      }
      text.put('\n');
    }
    text.finish();
  });
}

/// A normal has the number of its vertex.
template <typename Faces>
void writeFaces(const Faces& faces, bool normals, AtomicFile& file) {
  writeChunked(file, faces.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin + 2 * cornerCount(faces, begin, end)) * TextCursor::kMaxNumber);
    for (std::size_t i = begin; i < end; ++i) {
      text.put('f');
      for (const std::uint32_t v : faces[i]) {
        const std::uint64_t number = std::uint64_t{v} + 1;
        text.put(' ');
        text.put(number);
        if (!normals) continue;
        text.put('/');
        text.put('/');
        text.put(number);
      }
      text.put('\n');
    }
    text.finish();
  });
}

}  // namespace

void writeObj(const Mesh& mesh, AtomicFile& file, bool world) {
  const std::string header = fmt::format("# {}\n{}", kOwnComment, world ? "" : originLine(mesh, "# "));
  const bool normals = !mesh.normals.empty();
  file.write(header.data(), header.size());
  if (world) {
    writeVectors(worldPositions(mesh), false, file);
  } else {
    writeVectors(mesh.positions, false, file);
  }
  writeVectors(mesh.normals, true, file);
  writeFaces(mesh.quads, normals, file);
  writeFaces(mesh.triangles, normals, file);
  writeFaces(mesh.polygons, normals, file);
}

}  // namespace pdc::detail
