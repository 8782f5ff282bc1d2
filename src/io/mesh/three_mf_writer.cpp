#include "io/mesh/three_mf_writer.h"

#include <fmt/format.h>

#include <string>

#include "io/deflate/zip_output.h"
#include "io/file/text_format.h"
#include "io/file/xml_text.h"
#include "io/mesh/length_unit.h"
#include "mesh/faces.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kItemsPerChunk = 1 << 15;

constexpr std::string_view kContentTypes =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
)";
constexpr std::string_view kRelations =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
)";

void write(ByteOutput& out, std::string_view text) { out.write(text.data(), text.size()); }

void put(TextCursor& text, std::string_view constant) {
  for (const char c : constant) text.put(c);
}

std::string metadata(std::string_view name, std::string_view value) {
  return value.empty() ? "" : fmt::format("<metadata name=\"{}\">{}</metadata>\n", name, xmlText(value));
}

std::string head(const MeshWriteOptions& options) {
  const LengthUnit unit = lengthUnit(options.unit).value_or(*lengthUnit("mm"));
  const std::string frame = options.space.empty() ? "" : "SPACE=" + options.space;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{}\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
      "<metadata name=\"Application\">pdc</metadata>\n{}{}<resources>\n<object id=\"1\" type=\"model\"><mesh>\n",
      unit.threeMf, metadata("Title", options.source),
      metadata("Description", options.settings + (options.settings.empty() || frame.empty() ? "" : " ") + frame));
}

void writeVertices(const Mesh& mesh, ByteOutput& out) {
  constexpr std::size_t kTags = 32;
  const bool moved = mesh.origin != Vec3d{0, 0, 0};
  writeChunked(out, mesh.positions.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& chunk) {
    TextCursor text(chunk, (end - begin) * (3 * TextCursor::kMaxNumber + kTags));
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3f& p = mesh.positions[i];
      put(text, "<vertex");
      for (int axis = 0; axis < 3; ++axis) {
        put(text, axis == 0 ? " x=\"" : (axis == 1 ? " y=\"" : " z=\""));
        if (moved) {
          text.put(mesh.origin[axis] + static_cast<double>(p[axis]));
        } else {
          text.put(p[axis]);
        }
        text.put('"');
      }
      put(text, "/>\n");
    }
    text.finish();
  });
}

void writeTriangles(const Mesh& mesh, ByteOutput& out) {
  constexpr std::size_t kTags = 40;
  writeChunked(out, triangleCount(mesh), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& chunk) {
    TextCursor text(chunk, (end - begin) * (3 * TextCursor::kMaxNumber + kTags));
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle t = triangle(mesh, i);
      put(text, "<triangle v1=\"");
      text.put(t[0]);
      put(text, "\" v2=\"");
      text.put(t[1]);
      put(text, "\" v3=\"");
      text.put(t[2]);
      put(text, "\"/>\n");
    }
    text.finish();
  });
}

}  // namespace

void writeThreeMf(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options) {
  ZipOutput zip(file);
  zip.add("[Content_Types].xml", [](ByteOutput& out) { write(out, kContentTypes); });
  zip.add("_rels/.rels", [](ByteOutput& out) { write(out, kRelations); });
  zip.add("3D/3dmodel.model", [&](ByteOutput& out) {
    write(out, head(options));
    write(out, "<vertices>\n");
    writeVertices(mesh, out);
    write(out, "</vertices>\n<triangles>\n");
    writeTriangles(mesh, out);
    write(out, "</triangles>\n</mesh></object>\n</resources>\n<build><item objectid=\"1\"/></build>\n</model>\n");
  });
  zip.finish();
}

}  // namespace pdc::detail
