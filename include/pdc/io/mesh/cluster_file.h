#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/simplify/cluster.h"

namespace pdc {

/// Clusters the mesh in a file: cluster() of what readMesh() makes of it. Binary .ply and .stl files are streamed, so
/// that they may be larger than the memory: it holds the result, and those pages of the file that the system has room
/// for. The corners of a .ply file's faces are looked up where they stand in the file (Lindstrom 2000, section 3),
/// which is fast as long as its vertices fit into memory.
///
/// Streamed are, unless vertices are to be welded, .ply files whose vertices come before their faces and have no lists,
/// and .stl files that are as long as they say. Faces come in the order of the file, 4096 at a time: of these quads
/// come first, then triangles, then larger polygons. So files whose faces are all of one kind give the same bytes as
/// from memory.
///
/// \param warn see MeshReadOptions. \throws std::invalid_argument for options out of range; Error as readMesh() and
/// Clustering::add() do, naming the file; Cancelled, but not while a file is read whole. Progress: "cluster".
[[nodiscard]] Mesh clusterFile(const std::filesystem::path& path, const ClusterOptions& options,
                               ClusterReport* report = nullptr,
                               const std::function<void(const std::string&)>& warn = {}, const Monitor& monitor = {});

}  // namespace pdc
