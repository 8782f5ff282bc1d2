#include "io/vdb/vdb_grid.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <fstream>
#include <sstream>

#include "pdc/error.h"

namespace pdc::detail {
namespace {

void setVersion(std::ios_base& stream, const VdbFile& file) {
  openvdb::io::setVersion(stream, {file.libraryMajor(), file.libraryMinor()}, file.version());
}

/// Reads the tree at the place that the head names, once it is known that this can be done without harm.
openvdb::TreeBase::Ptr readTree(const std::filesystem::path& path, VdbFile& file, const VdbEntry& entry) {
  const VdbGridHead head = file.readHead(entry);
  const std::uint64_t end = file.checkTree(entry, head);

  std::vector<char> buffer(1 << 20);
  std::ifstream stream;
  stream.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  stream.open(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(head.tree));
  setVersion(stream, file);
  openvdb::io::setDataCompression(stream, head.compression);

  auto grid = openvdb::GridBase::createGrid(entry.type);
  grid->setSaveFloatAsHalf(head.half);
  grid->readTopology(stream);
  grid->readBuffers(stream);
  if (!stream || static_cast<std::uint64_t>(stream.tellg()) != end)
    throw Error(fmt::format("grid \"{}\" cannot be read", entry.shownName()));
  return grid->baseTreePtr();
}

/// Leaves of bool grids carry their origin a second time, and OpenVDB believes the second without looking at the first.
void checkLeafOrigins(const openvdb::GridBase& grid) {
  const auto* bools = dynamic_cast<const openvdb::BoolGrid*>(&grid);
  if (bools == nullptr) return;
  for (auto leaf = bools->tree().cbeginLeaf(); leaf; ++leaf)
    if (bools->tree().probeConstLeaf(leaf->origin()) != &*leaf) throw Error("a leaf that is not where it says");
}

const VdbEntry& treeOwner(const VdbFile& file, const VdbEntry& entry) {
  if (entry.parent.empty()) return entry;
  for (const VdbEntry& owner : file.entries())
    if (owner.uniqueName == entry.parent && owner.parent.empty() && owner.type == entry.type) return owner;
  throw Error(fmt::format("the tree of grid \"{}\" is missing", entry.shownName()));
}

}  // namespace

openvdb::MetaMap toMetaMap(const std::vector<VdbMetadata>& all) {
  openvdb::MetaMap map;
  for (const auto& [name, type, value] : all) {
    if (name.empty() || type.starts_with("__") || !openvdb::Metadata::isRegisteredType(type)) continue;
    const auto metadata = openvdb::Metadata::createMetadata(type);
    const auto size = static_cast<openvdb::Index32>(value.size());
    if (type != openvdb::StringMetadata::staticTypeName() && metadata->size() != size)
      throw Error(fmt::format("metadata {} of type {} has {} bytes", name, type, size));
    std::istringstream stream(std::string(reinterpret_cast<const char*>(&size), sizeof(size)) + value);
    metadata->read(stream);
    map.removeMeta(name);
    map.insertMeta(name, *metadata);
  }
  return map;
}

openvdb::math::Transform::Ptr toTransform(const VdbFile& file, const VdbGridHead& head) {
  std::istringstream stream(head.transform);
  setVersion(stream, file);
  auto transform = openvdb::math::Transform::createLinearTransform();
  transform->read(stream);
  return transform;
}

openvdb::GridBase::Ptr readGrid(const std::filesystem::path& path, VdbFile& file, const VdbEntry& entry) {
  const VdbGridHead head = file.readHead(entry);
  auto grid = openvdb::GridBase::createGrid(entry.type);
  grid->insertMeta(toMetaMap(head.metadata));
  grid->setSaveFloatAsHalf(head.half);
  grid->setTransform(toTransform(file, head));
  grid->setTree(readTree(path, file, treeOwner(file, entry)));
  checkLeafOrigins(*grid);
  return grid;
}

}  // namespace pdc::detail
