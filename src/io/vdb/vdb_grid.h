#pragma once

#include <openvdb/Grid.h>

#include <filesystem>
#include <vector>

#include "io/vdb/vdb_file.h"

/// Functions that turn the bytes of a VdbFile into OpenVDB's objects. All throw Error or what OpenVDB throws.
namespace pdc::detail {

/// The metadata whose type OpenVDB knows. \throws Error where the size is not the type's, because OpenVDB would read
/// past what is there. Temporary ones ("__..."), which only speed up delayed loading, are left out.
[[nodiscard]] openvdb::MetaMap toMetaMap(const std::vector<VdbMetadata>& all);

[[nodiscard]] openvdb::math::Transform::Ptr toTransform(const VdbFile& file, const VdbGridHead& head);

/// The grid with its tree, which is checked before OpenVDB reads it. `path` is where `file` was read from.
[[nodiscard]] openvdb::GridBase::Ptr readGrid(const std::filesystem::path& path, VdbFile& file, const VdbEntry& entry);

}  // namespace pdc::detail
