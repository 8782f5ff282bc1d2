#include "io/mesh/vtp_writer.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "io/file/chunked_output.h"
#include "io/file/xml_text.h"
#include "io/mesh/world_positions.h"
#include "mesh/faces.h"

namespace pdc::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::size_t kItemsPerChunk = 1 << 16;

const char* vtkType(const VertexProperty& property) {
  constexpr const char* kNames[] = {"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Float32", "Float64"};
  return kNames[property.values.index()];
}

/// A text among the data of the whole, as the numbers of its characters.
std::string textArray(std::string_view name, std::string_view text) {
  if (text.empty()) return "";
  std::string numbers;
  for (const char c : text) numbers += fmt::format("{} ", static_cast<unsigned char>(c));
  return fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}0</Array>\n", name,
                     numbers);
}

/// The arrays behind the header: those that are described first come first.
class Appended {
 public:
  /// The element that describes an array, which takes its place.
  std::string add(const char* type, std::string_view name, int components, std::uint64_t bytes) {
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        xmlText(name), components, mOffset);
    mOffset += sizeof(std::uint64_t) + bytes;
    return element;
  }

 private:
  std::uint64_t mOffset = 0;
};

void writeArray(ByteOutput& file, const void* data, std::uint64_t bytes) {
  file.write(&bytes, sizeof(bytes));
  file.write(data, bytes);
}

template <typename Values>
void writeArray(ByteOutput& file, const Values& values) {
  writeArray(file, values.data(), values.size() * sizeof(values[0]));
}

std::uint64_t bytesOf(const VertexProperty& property) {
  return std::visit([](const auto& values) { return values.size() * sizeof(values[0]); }, property.values);
}

std::uint64_t cornersOf(const Mesh& mesh) {
  std::uint64_t corners = 4 * mesh.quads.size() + 3 * mesh.triangles.size();
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) corners += mesh.polygons[i].size();
  return corners;
}

void writeConnectivity(const Mesh& mesh, ByteOutput& file, std::uint64_t corners) {
  const std::uint64_t bytes = corners * sizeof(std::uint32_t);
  file.write(&bytes, sizeof(bytes));
  file.write(mesh.quads.data(), mesh.quads.size() * sizeof(Quad));
  file.write(mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i)
    file.write(mesh.polygons[i].data(), mesh.polygons[i].size() * sizeof(std::uint32_t));
}

/// Where each face's corners end.
void writeOffsets(const Mesh& mesh, ByteOutput& file) {
  const std::uint64_t bytes = faceCount(mesh) * sizeof(std::int64_t);
  file.write(&bytes, sizeof(bytes));
  const std::size_t quads = mesh.quads.size(), regular = quads + mesh.triangles.size();
  writeChunked(file, regular, kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    out.resize((end - begin) * sizeof(std::int64_t));
    auto* to = reinterpret_cast<std::int64_t*>(out.data());
    for (std::size_t i = begin; i < end; ++i)
      *to++ = static_cast<std::int64_t>(i < quads ? 4 * (i + 1) : 4 * quads + 3 * (i + 1 - quads));
  });
  auto corners = static_cast<std::int64_t>(4 * quads + 3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    corners += static_cast<std::int64_t>(mesh.polygons[i].size());
    file.write(&corners, sizeof(corners));
  }
}

std::string header(const Mesh& mesh, const MeshWriteOptions& options, bool doubles) {
  Appended appended;
  const std::size_t vertices = mesh.positions.size();
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n{}{}{}{}</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      textArray("space", options.space), textArray("unit", options.unit), textArray("source", options.source),
      textArray("settings", options.settings), vertices, faceCount(mesh));
  text += "<Points>\n";
  text += appended.add(doubles ? "Float64" : "Float32", "Points", 3, vertices * (doubles ? 24 : 12));
  text += mesh.normals.empty() ? "</Points>\n<PointData>\n" : "</Points>\n<PointData Normals=\"Normals\">\n";
  if (!mesh.normals.empty()) text += appended.add("Float32", "Normals", 3, vertices * sizeof(Vec3f));
  for (const VertexProperty& property : mesh.properties)
    text += appended.add(vtkType(property), property.name, property.components, bytesOf(property));
  text += "</PointData>\n<Polys>\n";
  // VTK knows no unsigned connectivity; numbers below 2^31 are the same bytes.
  const bool large = vertices > std::size_t{std::numeric_limits<std::int32_t>::max()};
  text += appended.add(large ? "UInt32" : "Int32", "connectivity", 1, cornersOf(mesh) * sizeof(std::uint32_t));
  text += appended.add("Int64", "offsets", 1, faceCount(mesh) * sizeof(std::int64_t));
  return text + "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
}

}  // namespace

void writeVtp(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options) {
  const bool doubles = options.doublePrecision || mesh.origin != Vec3d{0, 0, 0};
  const std::string text = header(mesh, options, doubles);
  file.write(text.data(), text.size());
  if (doubles) {
    writeArray(file, worldPositions(mesh));
  } else {
    writeArray(file, mesh.positions);
  }
  if (!mesh.normals.empty()) writeArray(file, mesh.normals);
  for (const VertexProperty& property : mesh.properties)
    std::visit([&](const auto& values) { writeArray(file, values); }, property.values);
  writeConnectivity(mesh, file, cornersOf(mesh));
  writeOffsets(mesh, file);
  constexpr std::string_view kEnd = "\n</AppendedData>\n</VTKFile>\n";
  file.write(kEnd.data(), kEnd.size());
}

}  // namespace pdc::detail
