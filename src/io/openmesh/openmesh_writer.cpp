#include "io/openmesh/openmesh_writer.h"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/IOManager.hh>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <locale>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file/byte_output.h"
#include "io/openmesh/openmesh_quiet.h"
#include "io/openmesh/plain_exporter.h"
#include "io/parse/origin_text.h"
#include "mesh/faces.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

OpenMesh::Vec3f toOpenMesh(const Vec3f& v) { return {v.x, v.y, v.z}; }

/// Shows a Mesh to OpenMesh's writers: its faces or, with `split`, its triangles; then it must have no polygons.
class SoupExporter final : public PlainExporter {
 public:
  using PlainExporter::normal;

  SoupExporter(const Mesh& mesh, bool split) : mMesh(mesh), mSplit(split) {}

  size_t n_vertices() const override { return mMesh.positions.size(); }
  size_t n_faces() const override { return mSplit ? triangleCount(mMesh) : faceCount(mMesh); }
  OpenMesh::Vec3f point(VertexHandle v) const override { return toOpenMesh(position(v)); }
  bool has_face_normals() const override { return true; }

  unsigned int get_vhandles(FaceHandle f, std::vector<VertexHandle>& corners) const override {
    corners.clear();
    const auto i = static_cast<std::size_t>(f.idx());
    const auto add = [&](std::uint32_t v) { corners.emplace_back(static_cast<int>(v)); };
    if (mSplit) {
      for (const std::uint32_t v : triangle(mMesh, i)) add(v);
    } else {
      for (const std::uint32_t v : face(mMesh, i)) add(v);
    }
    return static_cast<unsigned int>(corners.size());
  }

  /// OpenMesh's own normals of triangles without area are NaN.
  OpenMesh::Vec3f normal(FaceHandle f) const override {
    std::vector<VertexHandle> corners;
    get_vhandles(f, corners);
    const auto a = vecCast<double>(position(corners[0]));
    const auto n = cross(vecCast<double>(position(corners[1])) - a, vecCast<double>(position(corners[2])) - a);
    const double size = length(n);
    return size > 0 ? toOpenMesh(vecCast<float>(n * (1.0 / size))) : OpenMesh::Vec3f(0.0f);
  }

 private:
  [[nodiscard]] const pdc::Vec3f& position(VertexHandle v) const {
    return mMesh.positions[static_cast<std::size_t>(v.idx())];
  }

  const Mesh& mMesh;
  bool mSplit;
};

/// What a file is to begin with in place of the bytes that OpenMesh begins it with.
struct Title {
  std::size_t replaced = 0;  ///< Bytes.
  std::string text{};
};

/// The title of a .stl file with the mesh's origin and its frame; OpenMesh's own if there is neither.
Title stlTitle(const Mesh& mesh, bool binary, const std::string& frame) {
  std::string text = mesh.origin == Vec3d{0, 0, 0} ? std::string() : originText(mesh.origin);
  if (text.empty() && frame.empty()) return {};
  constexpr std::size_t kHeader = 80;
  if (binary && text.size() > kHeader)
    throw Error(fmt::format("\"{}\" does not fit into the {} bytes of a .stl file's header", text, kHeader));
  const std::string both = text + (text.empty() || frame.empty() ? "" : " ") + frame;
  if (!binary) return {.replaced = std::string_view("solid \n").size(), .text = fmt::format("solid {}\n", both)};
  if (both.size() <= kHeader) text = both;
  text.resize(kHeader, ' ');
  return {.replaced = kHeader, .text = std::move(text)};
}

/// Takes what a stream writes into a ByteOutput.
class FileBuffer final : public std::streambuf {
 public:
  FileBuffer(ByteOutput& file, Title title) : mFile(file), mTitle(std::move(title)), mBytes(1 << 20) { reset(); }

  void flush() {
    // The buffer is larger than any title, so its bytes come together.
    const std::size_t size = static_cast<std::size_t>(pptr() - pbase()), replaced = std::min(size, mTitle.replaced);
    mFile.write(mTitle.text.data(), mTitle.text.size());
    mFile.write(pbase() + replaced, size - replaced);
    mTitle = {};
    reset();
  }

 protected:
  int_type overflow(int_type c) override {
    flush();
    return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                           : sputc(traits_type::to_char_type(c));
  }

 private:
  void reset() { setp(mBytes.data(), mBytes.data() + mBytes.size()); }

  ByteOutput& mFile;
  Title mTitle;
  std::vector<char> mBytes;
};

/// \param title of a .stl file; empty for a .off file, whose quads stay.
void write(const Mesh& mesh, ByteOutput& file, const std::optional<Title>& title,
           const OpenMesh::IO::Options& options) {
  const bool split = title.has_value();
  const char* const format = split ? "stl" : "off";
  SoupExporter exporter(mesh, split);
  constexpr auto kMax = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (exporter.n_faces() > kMax || exporter.n_vertices() > kMax)
    throw Error(fmt::format("a .{} file takes at most {} vertices and faces, the mesh has {} and {}", format, kMax,
                            exporter.n_vertices(), exporter.n_faces()));
  FileBuffer buffer(file, title.value_or(Title{}));
  std::ostream stream(&buffer);
  stream.imbue(std::locale::classic());
  stream.exceptions(std::ios::badbit);  // lets Error through from the buffer
  const OpenMeshQuiet quiet;
  if (!OpenMesh::IO::IOManager().write(stream, format, exporter, options, std::numeric_limits<float>::max_digits10))
    throw Error(fmt::format("OpenMesh cannot write this mesh as .{}", format));
  buffer.flush();
}

}  // namespace

void writeStl(const Mesh& mesh, ByteOutput& file, bool ascii, const std::string& frame) {
  const auto kind = ascii ? OpenMesh::IO::Options::Default : OpenMesh::IO::Options::Binary;
  const Title title = stlTitle(mesh, !ascii, frame);
  write(mesh, file, title, kind);
}

void writeOff(const Mesh& mesh, ByteOutput& file, const std::string& frame) {
  write(mesh, file, std::nullopt, OpenMesh::IO::Options::Default);
  // Comments come last, where no reader minds them.
  std::string comments = originLine(mesh, "# ") + commentLine(frame, "# ");
  if (!mesh.quads.empty()) comments += fmt::format("# {}\n", kOwnComment);
  file.write(comments.data(), comments.size());
}

}  // namespace pdc::detail
