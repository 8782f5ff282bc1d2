#pragma once

#include <openvdb/Grid.h>

#include <filesystem>
#include <vector>

#include "io/vdb/vdb_file.h"

/// From the bytes of a VdbFile to OpenVDB's objects. All of these throw Error or what OpenVDB throws.
namespace pdc::detail {

/// Metadata whose type OpenVDB knows and whose size is that type's; OpenVDB's own reader would read past what is there.
/// Temporary ones ("__..."), which only speed up delayed loading, are left out.
[[nodiscard]] openvdb::MetaMap toMetaMap(const std::vector<VdbMetadata>& all);

[[nodiscard]] openvdb::math::Transform::Ptr toTransform(const VdbFile& file, const VdbGridHead& head);

/// The grid with its tree, which is checked before OpenVDB reads it. `path` is where `file` was read from.
[[nodiscard]] openvdb::GridBase::Ptr readGrid(const std::filesystem::path& path, VdbFile& file, const VdbEntry& entry);

}  // namespace pdc::detail
