#include "io/mesh/glb_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "io/file/chunked_output.h"
#include "io/mesh/length_unit.h"
#include "io/mesh/vertex_colours.h"
#include "mesh/faces.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

using nlohmann::ordered_json;

// glTF 2.0, sections 4.4 (binary) and 5.1 (accessors).
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kUnsignedByte = 5121, kUnsignedInt = 5125, kFloat = 5126, kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr std::size_t kItemsPerChunk = 1 << 16;

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

/// The bounds that the accessor of positions has to have.
void addBounds(const Mesh& mesh, ordered_json& accessor) {
  Vec3f low = mesh.positions[0], high = low;
  for (const Vec3f& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  accessor["min"] = {low.x, low.y, low.z};
  accessor["max"] = {high.x, high.y, high.z};
}

/// What describes the bytes behind it, in their order.
class Description {
 public:
  /// \returns the number of an accessor of `count` items at the end of what is described.
  std::size_t add(std::size_t count, std::uint64_t bytes, int component, const char* type, int target) {
    mViews.push_back({{"buffer", 0}, {"byteOffset", mBytes}, {"byteLength", bytes}, {"target", target}});
    mAccessors.push_back(
        {{"bufferView", mViews.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    mBytes += padded(bytes);
    return mAccessors.size() - 1;
  }
  ordered_json& accessor(std::size_t number) { return mAccessors[number]; }
  [[nodiscard]] const ordered_json& views() const { return mViews; }
  [[nodiscard]] const ordered_json& accessors() const { return mAccessors; }
  [[nodiscard]] std::uint64_t bytes() const { return mBytes; }

 private:
  ordered_json mViews = ordered_json::array(), mAccessors = ordered_json::array();
  std::uint64_t mBytes = 0;
};

const char* typeOf(int components) {
  constexpr std::array<const char*, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kTypes[static_cast<std::size_t>(components - 1)];
}

bool isShownAsColour(const Mesh& mesh, const VertexProperty& property) {
  return isColour(property.name) && hasColours(mesh);
}

ordered_json primitiveOf(const Mesh& mesh, Description& description) {
  const std::size_t vertices = mesh.positions.size();
  ordered_json attributes;
  const std::size_t positions = description.add(vertices, vertices * sizeof(Vec3f), kFloat, "VEC3", kArrayBuffer);
  addBounds(mesh, description.accessor(positions));
  attributes["POSITION"] = positions;
  if (!mesh.normals.empty())
    attributes["NORMAL"] = description.add(vertices, vertices * sizeof(Vec3f), kFloat, "VEC3", kArrayBuffer);
  if (hasColours(mesh)) {
    attributes["COLOR_0"] = description.add(vertices, vertices * 4, kUnsignedByte, "VEC4", kArrayBuffer);
    description.accessor(attributes["COLOR_0"])["normalized"] = true;
  }
  for (const VertexProperty& p : mesh.properties) {
    if (isShownAsColour(mesh, p)) continue;
    const auto bytes = vertices * static_cast<std::size_t>(p.components) * sizeof(float);
    attributes["_" + p.name] = description.add(vertices, bytes, kFloat, typeOf(p.components), kArrayBuffer);
  }
  const std::size_t corners = 3 * triangleCount(mesh);
  const std::size_t indices =
      description.add(corners, corners * sizeof(std::uint32_t), kUnsignedInt, "SCALAR", kElementBuffer);
  return {{"attributes", attributes}, {"indices", indices}, {"mode", 4}};
}

ordered_json documentOf(const Mesh& mesh, const MeshWriteOptions& options, Description& description) {
  ordered_json extras = ordered_json::object();
  for (const auto& [key, value] : {std::pair{"space", options.space},
                                   {"unit", options.unit},
                                   {"source", options.source},
                                   {"settings", options.settings}})
    if (!value.empty()) extras[key] = value;
  ordered_json document{{"asset", {{"version", "2.0"}, {"generator", "pdc"}}}};
  if (!extras.empty()) document["asset"]["extras"] = extras;
  document["scene"] = 0;
  document["scenes"] = {{{"nodes", {0}}}};
  // glTF has y up and metres.
  const double turn = std::sqrt(0.5), metres = lengthUnit(options.unit).value_or(*lengthUnit("m")).metres;
  ordered_json frame{{"rotation", {-turn, 0, 0, turn}}, {"scale", {metres, metres, metres}}, {"children", {1}}};
  ordered_json place{{"translation", {mesh.origin.x, mesh.origin.y, mesh.origin.z}}};
  if (mesh.empty()) {
    document["nodes"] = {frame, place};
    return document;
  }
  place["mesh"] = 0;
  document["nodes"] = {frame, place};
  document["meshes"] = {{{"primitives", {primitiveOf(mesh, description)}}}};
  document["accessors"] = description.accessors();
  document["bufferViews"] = description.views();
  document["buffers"] = {{{"byteLength", description.bytes()}}};
  return document;
}

void writeColours(const Mesh& mesh, ByteOutput& file) {
  const auto red = mesh.values<std::uint8_t>("red"), green = mesh.values<std::uint8_t>("green"),
             blue = mesh.values<std::uint8_t>("blue");
  writeChunked(file, red.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    for (std::size_t i = begin; i < end; ++i)
      for (const std::uint8_t c : {red[i], green[i], blue[i], std::uint8_t{255}}) out.push_back(static_cast<char>(c));
  });
}

void writeFloats(const VertexProperty& property, ByteOutput& file) {
  std::visit(
      [&](const auto& values) {
        writeChunked(file, values.size(), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
          out.resize((end - begin) * sizeof(float));
          auto* to = reinterpret_cast<float*>(out.data());
          for (std::size_t i = begin; i < end; ++i) *to++ = static_cast<float>(values[i]);
        });
      },
      property.values);
}

void writeIndices(const Mesh& mesh, ByteOutput& file) {
  writeChunked(file, triangleCount(mesh), kItemsPerChunk, [&](std::size_t begin, std::size_t end, ChunkBuffer& out) {
    out.resize((end - begin) * sizeof(Triangle));
    auto* to = reinterpret_cast<Triangle*>(out.data());
    for (std::size_t i = begin; i < end; ++i) *to++ = triangle(mesh, i);
  });
}

/// In the order in which primitiveOf() describes them; only colours and numbers of four bytes are there, so nothing
/// needs padding.
void writeArrays(const Mesh& mesh, ByteOutput& file) {
  file.write(mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
  if (!mesh.normals.empty()) file.write(mesh.normals.data(), mesh.normals.size() * sizeof(Vec3f));
  if (hasColours(mesh)) writeColours(mesh, file);
  for (const VertexProperty& p : mesh.properties)
    if (!isShownAsColour(mesh, p)) writeFloats(p, file);
  writeIndices(mesh, file);
}

}  // namespace

void writeGlb(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options) {
  Description description;
  std::string json = documentOf(mesh, options, description).dump();
  json.resize(padded(json.size()), ' ');
  const std::uint64_t binary = description.bytes(), all = 12 + 8 + json.size() + (binary > 0 ? 8 + binary : 0);
  if (all > std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("{} bytes do not fit into a .glb file, which takes 4 GiB", all));
  const std::array<std::uint32_t, 5> header{kMagic, kVersion, static_cast<std::uint32_t>(all),
                                            static_cast<std::uint32_t>(json.size()), kJsonChunk};
  file.write(header.data(), sizeof(header));
  file.write(json.data(), json.size());
  if (binary == 0) return;
  const std::array<std::uint32_t, 2> chunk{static_cast<std::uint32_t>(binary), kBinaryChunk};
  file.write(chunk.data(), sizeof(chunk));
  writeArrays(mesh, file);
}

}  // namespace pdc::detail
