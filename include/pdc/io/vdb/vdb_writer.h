#pragma once

#include <openvdb/Grid.h>

#include <cstddef>
#include <filesystem>

namespace pdc {

/// Writes one grid as a .vdb file, compressed as OpenVDB does by default. The file appears under its name only when it
/// is complete, and the same grid gives the same bytes: what identifies a file, which OpenVDB draws by chance, comes
/// from its content. \returns bytes written. \throws std::invalid_argument for null; Error for another suffix and for a
/// file that cannot be written.
std::size_t writeVdb(const openvdb::GridBase::ConstPtr& grid, const std::filesystem::path& path);

/// Checks the suffix and whether the file can be written, and makes none. \throws Error.
void checkVdbPath(const std::filesystem::path& path);

}  // namespace pdc
