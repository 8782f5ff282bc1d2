#include "io/mesh/obj_writer.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/file/byte_output.h"
#include "io/file/chunked_output.h"
#include "io/file/text_format.h"
#include "io/mesh/corner_count.h"
#include "io/mesh/vertex_colours.h"
#include "io/mesh/world_positions.h"
#include "io/parse/origin_text.h"

namespace pdc::detail {
namespace {

/// A chunk is about a megabyte of text.
constexpr std::size_t kItemsPerChunk = 1 << 15;

/// The colours of a mesh's vertices, if they have any.
class Colours {
 public:
  explicit Colours(const Mesh& mesh) {
    if (!hasColours(mesh)) return;
    for (const char* const name : {"red", "green", "blue"}) mBytes.push_back(mesh.values<std::uint8_t>(name));
  }

  void put(TextCursor& text, std::size_t vertex) const {
    for (const auto& bytes : mBytes) {
      text.put(' ');
      text.put(static_cast<float>(bytes[vertex]) / 255.0F);
    }
  }

 private:
  std::vector<std::span<const std::uint8_t>> mBytes;
};

template <typename Real>
void writeVectors(const Buffer<Vec3<Real>>& vectors, const Colours* colours, ByteOutput& file) {
  const bool normals = colours == nullptr;
  writeChunked(file, vectors.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    TextCursor text(out, (end - begin) * 7 * TextCursor::kMaxNumber);
    for (std::size_t i = begin; i < end; ++i) {
      text.put('v');
      if (normals) text.put('n');
      for (int axis = 0; axis < 3; ++axis) {
        text.put(' ');
        text.put(vectors[i][axis]);
      }
      if (!normals) colours->put(text, i);
      text.put('\n');
    }
    text.finish();
  });
}

/// A normal has the number of its vertex.
template <typename Faces>
void writeFaces(const Faces& faces, bool normals, ByteOutput& file) {
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

void writeObj(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options) {
  const bool world = options.doublePrecision;
  const std::string header = fmt::format("# {}\n{}{}", kOwnComment, world ? "" : originLine(mesh, "# "),
                                         commentLine(frameText(options.space, options.unit), "# "));
  const bool normals = !mesh.normals.empty();
  const Colours colours(mesh);
  file.write(header.data(), header.size());
  if (world) {
    writeVectors(worldPositions(mesh), &colours, file);
  } else {
    writeVectors(mesh.positions, &colours, file);
  }
  writeVectors(mesh.normals, nullptr, file);
  writeFaces(mesh.quads, normals, file);
  writeFaces(mesh.triangles, normals, file);
  writeFaces(mesh.polygons, normals, file);
}

}  // namespace pdc::detail
