#include "pdc/io/vdb/vdb_reader.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "io/file/closest_word.h"
#include "io/file/file_error.h"
#include "io/vdb/vdb_file.h"
#include "io/vdb/vdb_grid.h"
#include "io/vdb/vdb_tree_check.h"
#include "parallel/machine_memory.h"
#include "sample/meaning/contourable_grids.h"

namespace pdc {
namespace {

using detail::VdbEntry;
using detail::VdbFile;
using detail::VdbGridHead;

/// Runs `action` and puts the file's name before the message of every error.
template <typename Action>
auto withFileName(const std::filesystem::path& path, Action&& action) {
  try {
    openvdb::initialize();
    return action();
  } catch (const std::bad_alloc&) {
    throw detail::fileError(path, "does not fit into memory: " + detail::memoryFigures());
  } catch (const std::exception& error) {
    throw detail::fileError(path, error.what());
  }
}

/// The value's part of a tree's type: "float" for "Tree_float_5_4_3".
std::string valueType(std::string type) {
  if (type.starts_with("Tree_")) type.erase(0, 5);
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  for (;;) {
    const std::size_t last = type.rfind('_');
    if (last == std::string::npos || last + 1 == type.size()) return type;
    if (!std::all_of(type.begin() + static_cast<std::ptrdiff_t>(last) + 1, type.end(), isDigit)) return type;
    type.resize(last);
  }
}

std::string transformKind(const openvdb::math::Transform& transform) {
  std::string type = transform.mapType();
  if (type == "UniformScaleMap") return "uniform scale";
  if (type == "UniformScaleTranslateMap") return "uniform scale, translation";
  if (type == "ScaleMap") return "scale";
  if (type == "ScaleTranslateMap") return "scale, translation";
  if (type == "TranslationMap") return "translation";
  if (type == "UnitaryMap") return "rotation";
  if (type == "AffineMap") return "affine";
  if (type == "NonlinearFrustumMap") return "frustum";
  return type;
}

template <typename Value>
Value metaValue(const openvdb::MetaMap& map, const char* name, const Value& otherwise) {
  const auto metadata = map.getMetadata<openvdb::TypedMetadata<Value>>(name);
  return metadata ? metadata->value() : otherwise;
}

void setBounds(VdbGridInfo& info, const openvdb::Coord& lo, const openvdb::Coord& hi) {
  info.boundsLo = {lo.x(), lo.y(), lo.z()};
  info.boundsHi = {hi.x(), hi.y(), hi.z()};
}

/// All that can be known without the tree. Bounds and number of voxels are what the file's writer noted.
VdbGridInfo describe(const VdbFile& file, const VdbEntry& entry, const VdbGridHead& head) {
  using openvdb::GridBase;
  const openvdb::MetaMap map = detail::toMetaMap(head.metadata);
  const auto transform = detail::toTransform(file, head);
  const openvdb::Vec3d voxel = transform->voxelSize(openvdb::Vec3d(0.0));
  VdbGridInfo info;
  info.name = entry.shownName();
  info.valueType = valueType(entry.type);
  info.gridClass = GridBase::gridClassToString(
      GridBase::stringToGridClass(metaValue<std::string>(map, GridBase::META_GRID_CLASS, "")));
  info.transform = transformKind(*transform);
  info.savedAsHalf = head.half;
  info.contourable = detail::isContourableVdbTree(entry.type);
  info.voxelSize = {voxel.x(), voxel.y(), voxel.z()};
  info.activeVoxels = static_cast<std::size_t>(
      std::max<openvdb::Int64>(0, metaValue<openvdb::Int64>(map, GridBase::META_FILE_VOXEL_COUNT, 0)));
  const auto lo = metaValue<openvdb::Vec3i>(map, GridBase::META_FILE_BBOX_MIN, openvdb::Vec3i(1));
  const auto hi = metaValue<openvdb::Vec3i>(map, GridBase::META_FILE_BBOX_MAX, openvdb::Vec3i(0));
  setBounds(info, openvdb::Coord(lo), openvdb::Coord(hi));
  return info;
}

struct Range {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;

  /// NaN changes nothing.
  template <typename Value>
  void add(Value value) {
    const auto v = static_cast<double>(value);
    if (v < lo) lo = v;
    if (v > hi) hi = v;
  }
};

template <typename Tree>
Range activeRange(const Tree& tree) {
  std::vector<const typename Tree::LeafNodeType*> leaves;
  tree.getNodes(leaves);
  Range range = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, leaves.size(), 64), Range{},
      [&](const auto& part, Range sum) {
        for (std::size_t i = part.begin(); i != part.end(); ++i)
          for (auto value = leaves[i]->cbeginValueOn(); value; ++value) sum.add(*value);
        return sum;
      },
      [](Range a, const Range& b) {
        a.add(b.lo);
        a.add(b.hi);
        return a;
      });
  auto tile = tree.cbeginValueOn();
  tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
  for (; tile; ++tile) range.add(*tile);
  return range;
}

void describeVoxels(const openvdb::GridBase& grid, VdbGridInfo& info) {
  info.activeVoxels = grid.activeVoxelCount();
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  setBounds(info, box.empty() ? openvdb::Coord(1) : box.min(), box.empty() ? openvdb::Coord(0) : box.max());
  detail::visitContourable(grid, [&](const auto& typed) {
    info.background = static_cast<double>(typed.background());
    const Range range = activeRange(typed.tree());
    if (range.lo > range.hi) return;
    info.valueMin = range.lo;
    info.valueMax = range.hi;
  });
}

std::string listNames(const VdbFile& file, bool contourable) {
  std::string list;
  for (const VdbEntry& entry : file.entries())
    if (detail::isContourableVdbTree(entry.type) == contourable)
      list += fmt::format("{}\"{}\" ({})", list.empty() ? "" : ", ", entry.shownName(), valueType(entry.type));
  return list;
}

/// The grids that can be contoured, and apart from them the others.
std::string listNames(const VdbFile& file) {
  const std::string taken = listNames(file, true), others = listNames(file, false);
  if (others.empty()) return taken.empty() ? "nothing" : taken;
  if (taken.empty()) return others;
  return fmt::format("{}; {} cannot be contoured", taken, others);
}

const VdbEntry& findEntry(const VdbFile& file, const std::string& name) {
  const VdbEntry* found = nullptr;
  for (const VdbEntry& entry : file.entries()) {
    const bool wanted = name.empty() ? detail::isContourableVdbTree(entry.type) : entry.shownName() == name;
    if (!wanted) continue;
    if (found != nullptr && name.empty())
      throw Error(fmt::format("more than one grid can be contoured; choose one by name: {}", listNames(file)));
    if (found == nullptr) found = &entry;
  }
  if (found == nullptr && name.empty()) throw Error("no grid can be contoured; there is " + listNames(file));
  if (found == nullptr) {
    std::vector<std::string> names;
    for (const VdbEntry& entry : file.entries()) names.push_back(entry.shownName());
    throw Error(fmt::format("no grid \"{}\"{}; there is {}", name, detail::didYouMean(name, names), listNames(file)));
  }
  return *found;
}

}  // namespace

std::vector<VdbGridInfo> listVdbGrids(const std::filesystem::path& path) {
  std::vector<VdbGridInfo> grids;
  visitVdbGrids(path, [&](const VdbGridInfo& info, const openvdb::GridBase::Ptr&) { grids.push_back(info); });
  return grids;
}

void visitVdbGrids(const std::filesystem::path& path,
                   const std::function<void(const VdbGridInfo&, const openvdb::GridBase::Ptr&)>& visit) {
  withFileName(path, [&] {
    VdbFile file(path);
    for (const VdbEntry& entry : file.entries()) {
      VdbGridInfo info = describe(file, entry, file.readHead(entry));
      openvdb::GridBase::Ptr grid;
      if (info.contourable) {
        grid = detail::readGrid(path, file, entry);
        describeVoxels(*grid, info);
      }
      visit(info, grid);
    }
  });
}

openvdb::GridBase::Ptr readVdbGrid(const std::filesystem::path& path, const std::string& name) {
  return withFileName(path, [&] {
    VdbFile file(path);
    const VdbEntry& entry = findEntry(file, name);
    if (!detail::isContourableVdbTree(entry.type))
      throw Error(fmt::format("grid \"{}\" of type {} cannot be contoured; {} can", entry.shownName(),
                              valueType(entry.type), detail::contourableTypeNames()));
    return detail::readGrid(path, file, entry);
  });
}

std::vector<VdbGridName> listVdbNames(const std::filesystem::path& path) {
  return withFileName(path, [&] {
    const VdbFile file(path);
    std::vector<VdbGridName> names;
    for (const VdbEntry& entry : file.entries())
      names.push_back({entry.shownName(), valueType(entry.type), detail::isContourableVdbTree(entry.type),
                       detail::isSampledVdbTree(entry.type)});
    return names;
  });
}

openvdb::GridBase::Ptr readVdbAttribute(const std::filesystem::path& path, const std::string& name) {
  return withFileName(path, [&] {
    if (name.empty()) throw Error("the name of an attribute is empty");
    VdbFile file(path);
    const VdbEntry& entry = findEntry(file, name);
    if (!detail::isSampledVdbTree(entry.type))
      throw Error(fmt::format("grid \"{}\" of type {} cannot be sampled; {} can", entry.shownName(),
                              valueType(entry.type), detail::gridTypeNames<detail::SampledGrids>()));
    return detail::readGrid(path, file, entry);
  });
}

}  // namespace pdc
