#include "tile/slab_file.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/file/atomic_file.h"
#include "io/file/file_error.h"
#include "io/file/mapped_file.h"
#include "math/hash128.h"

namespace pdc::detail {
namespace {

using Json = nlohmann::ordered_json;

// A slab's file is a line that names its kind, the length of a text and that text, which is JSON, then the arrays that
// it counts, as they lie in memory, and the hash of all that.
constexpr std::string_view kKind = "pdc slab 1\n";
constexpr std::size_t kLengthDigits = 12;

Json toJson(const MeshSlab::Counts& counts) { return {counts.solved, counts.added}; }

Json toJson(const MeshSlab::Seam& seam) {
  Json list = Json::array();
  for (const LayerHash& layer : seam) list.push_back({layer.sum[0], layer.sum[1]});
  return list;
}

MeshSlab::Counts countsFrom(const Json& json) {
  return {json.at(0).get<std::uint64_t>(), json.at(1).get<std::uint64_t>()};
}

MeshSlab::Seam seamFrom(const Json& json) {
  MeshSlab::Seam seam;
  for (const Json& layer : json) seam.push_back({{layer.at(0).get<std::uint64_t>(), layer.at(1).get<std::uint64_t>()}});
  return seam;
}

Json toJson(const SlabHeader& header, const Mesh& mesh) {
  Json properties = Json::array();
  for (const VertexProperty& p : mesh.properties)
    properties.push_back({{"name", p.name}, {"components", p.components}, {"type", p.values.index()}});
  return {{"plan", header.plan},
          {"slab", header.slab},
          {"halo", header.halo},
          {"own", toJson(header.own)},
          {"layer_before", toJson(header.layerBefore)},
          {"last_layer", toJson(header.lastLayer)},
          {"low", toJson(header.low)},
          {"high", toJson(header.high)},
          {"blocks", header.blocks},
          {"multi_vertex_cells", header.multiVertexCells},
          {"boundary_edges", header.boundaryEdges},
          {"uncertified", header.uncertified},
          {"origin", {mesh.origin.x, mesh.origin.y, mesh.origin.z}},
          {"normals", !mesh.normals.empty()},
          {"properties", properties},
          {"quads", mesh.quads.size()},
          {"triangles", mesh.triangles.size()}};
}

SlabHeader headerFrom(const Json& json) {
  const auto count = [&](const char* name) { return json.at(name).get<std::uint64_t>(); };
  return {.plan = json.at("plan").get<std::string>(),
          .slab = count("slab"),
          .halo = json.at("halo").get<int>(),
          .own = countsFrom(json.at("own")),
          .layerBefore = countsFrom(json.at("layer_before")),
          .lastLayer = countsFrom(json.at("last_layer")),
          .low = seamFrom(json.at("low")),
          .high = seamFrom(json.at("high")),
          .blocks = count("blocks"),
          .multiVertexCells = count("multi_vertex_cells"),
          .boundaryEdges = count("boundary_edges"),
          .uncertified = count("uncertified"),
          .quads = count("quads"),
          .triangles = count("triangles")};
}

/// An empty buffer of the type that a variant has at an index.
template <std::size_t I = 0>
PropertyValues emptyValues(std::size_t index) {
  if constexpr (I < std::variant_size_v<PropertyValues>) {
    return index == I ? PropertyValues(std::in_place_index<I>) : emptyValues<I + 1>(index);
  } else {
    throw Error("a property is of no type");
  }
}

/// Bytes to a file and into a hash.
class HashedOutput {
 public:
  explicit HashedOutput(AtomicFile& file) : mFile(file) {}

  void write(const void* data, std::size_t size) {
    if (size == 0) return;
    mFile.write(data, size);
    mHash.add(data, size);
  }
  template <typename Array>
  void writeArray(const Array& array) {
    write(array.data(), array.size() * sizeof(array[0]));
  }
  void finish() {
    const Hash128 hash = mHash.hash();
    mFile.write(hash.data(), sizeof hash);
    mFile.commit();
  }

 private:
  AtomicFile& mFile;
  StreamHash mHash;
};

}  // namespace

void writeSlabFile(const std::filesystem::path& path, const MeshSlab& slab, const SlabHeader& header) {
  const std::string text = toJson(header, slab.mesh).dump();
  AtomicFile file(path);
  HashedOutput out(file);
  const std::string begin = fmt::format("{}{:0{}}", kKind, text.size(), kLengthDigits);
  out.write(begin.data(), begin.size());
  out.write(text.data(), text.size());
  out.writeArray(slab.mesh.positions);
  out.writeArray(slab.mesh.normals);
  for (const VertexProperty& p : slab.mesh.properties)
    std::visit([&](const auto& values) { out.writeArray(values); }, p.values);
  out.writeArray(slab.mesh.quads);
  out.writeArray(slab.mesh.triangles);
  out.finish();
}

/// Where arrays begin, in bytes.
struct SlabFile::Layout {
  struct Property {
    VertexProperty like;  ///< Without values.
    std::size_t at, bytesEach;
  };
  Vec3d origin{};
  std::size_t positions = 0, normals = 0, quads = 0, triangles = 0, end = 0;
  bool hasNormals = false;
  std::vector<Property> properties;

  /// \param begin of the arrays.
  Layout(const Json& json, const SlabHeader& header, std::size_t begin) {
    const std::size_t vertices = header.own.solved + header.own.added;
    std::size_t next = begin;
    const auto take = [&next](std::size_t bytes) { return std::exchange(next, next + bytes); };
    for (int axis = 0; axis < 3; ++axis) origin[axis] = json.at("origin").at(axis).get<double>();
    positions = take(vertices * sizeof(Vec3f));
    hasNormals = json.at("normals").get<bool>();
    if (hasNormals) normals = take(vertices * sizeof(Vec3f));
    for (const Json& p : json.at("properties")) {
      VertexProperty like{.name = p.at("name").get<std::string>(),
                          .components = p.at("components").get<int>(),
                          .values = emptyValues(p.at("type").get<std::size_t>())};
      const std::size_t each = static_cast<std::size_t>(like.components) *
                               std::visit([](const auto& values) { return sizeof(values[0]); }, like.values);
      properties.push_back({std::move(like), take(vertices * each), each});
    }
    quads = take(header.quads * sizeof(Quad));
    triangles = take(header.triangles * sizeof(Triangle));
    end = next;
  }
};

SlabFile::SlabFile(const std::filesystem::path& path, const std::string& plan, std::size_t slab) : mPath(path) {
  std::unique_ptr<const MappedFile> bytes;
  try {
    bytes = std::make_unique<const MappedFile>(path);
  } catch (const Error& error) {
    throw fileError(path, error.what());
  }
  const std::string_view all(bytes->bytes().data(), bytes->bytes().size());
  const std::size_t textAt = kKind.size() + kLengthDigits;
  if (!all.starts_with(kKind) || all.size() < textAt) throw fileError(path, "is no slab of this version");
  try {
    const std::size_t length = std::stoull(std::string(all.substr(kKind.size(), kLengthDigits)));
    if (length > all.size() - textAt) throw Error("is cut short");
    const Json json = Json::parse(all.substr(textAt, length));
    mHeader = headerFrom(json);
    mLayout = std::make_unique<const Layout>(json, mHeader, textAt + length);
  } catch (const Error& error) {
    throw fileError(path, error.what());
  } catch (const std::exception&) {
    throw fileError(path, "is damaged");
  }
  if (mHeader.plan != plan || mHeader.slab != slab) throw fileError(path, "belongs to another plan");
  if (all.size() != mLayout->end + sizeof(Hash128)) throw fileError(path, "is cut short");
  mBytes = std::move(bytes);
}

SlabFile::~SlabFile() = default;

SlabFile::SlabFile(SlabFile&&) noexcept = default;

void SlabFile::check() const {
  const std::span<const char> bytes = mBytes->bytes();
  Hash128 written{};
  std::memcpy(written.data(), bytes.data() + mLayout->end, sizeof written);
  if (hashOf(bytes.first(mLayout->end)) != written) throw fileError(mPath, "is damaged");
}

void SlabFile::forget() const { mBytes->forget(0, mBytes->bytes().size()); }

Mesh SlabFile::vertices(std::size_t begin, std::size_t end) const {
  const auto read = [&](auto& array, std::size_t from, std::size_t each) {
    array.resize((end - begin) * each / sizeof(array[0]));
    if (!array.empty()) std::memcpy(array.data(), mBytes->bytes().data() + from + begin * each, (end - begin) * each);
  };
  Mesh mesh;
  mesh.origin = mLayout->origin;
  read(mesh.positions, mLayout->positions, sizeof(Vec3f));
  if (mLayout->hasNormals) read(mesh.normals, mLayout->normals, sizeof(Vec3f));
  for (const Layout::Property& p : mLayout->properties) {
    mesh.properties.push_back(p.like);
    std::visit([&](auto& values) { read(values, p.at, p.bytesEach); }, mesh.properties.back().values);
  }
  return mesh;
}

Mesh SlabFile::solvedVertices() const { return vertices(0, mHeader.own.solved); }

Mesh SlabFile::addedVertices() const { return vertices(mHeader.own.solved, mHeader.own.solved + mHeader.own.added); }

Mesh SlabFile::quads() const {
  Mesh mesh;
  mesh.quads.resize(mHeader.quads);
  if (mHeader.quads > 0)
    std::memcpy(mesh.quads.data(), mBytes->bytes().data() + mLayout->quads, mHeader.quads * sizeof(Quad));
  return mesh;
}

Mesh SlabFile::triangles() const {
  Mesh mesh;
  mesh.triangles.resize(mHeader.triangles);
  if (mHeader.triangles > 0)
    std::memcpy(mesh.triangles.data(), mBytes->bytes().data() + mLayout->triangles,
                mHeader.triangles * sizeof(Triangle));
  return mesh;
}

}  // namespace pdc::detail
