#pragma once

#include <filesystem>
#include <optional>

#include "pdc/extract/contour_forecast.h"
#include "pdc/io/open_input.h"
#include "pdc/tile/slab_folder.h"

namespace pdc {

/// What became of a mesh that was contoured slab by slab.
struct SlabbedMesh {
  SlabMergeReport merged;
  SlabRunReport run;
  std::size_t slabs = 0;
  Vec3d origin{};
};

/// Whether a mesh can be contoured slab by slab, and written so: a .ply that is not adaptive, of no more vertices than
/// files number, where the list of all blocks fits into memory. \param forecast nothing if it is not known how large
/// the mesh will be. \throws Error if the disk has no room for its slabs.
[[nodiscard]] bool canBeInSlabs(const std::filesystem::path& output, const ContourOptions& options,
                                const std::optional<ContourForecast>& forecast);
/// \throws Error, which says why, if the output or the options do not allow it.
void checkSlabs(const std::filesystem::path& output, const ContourOptions& options);

/// Contours slabs of an input as large as fit into options.maxMemory, in a folder beside the output, which is there
/// meanwhile only, and joins them. The output has the bytes of the mesh that is contoured as one. \throws Error,
/// Cancelled; nothing is left then.
[[nodiscard]] SlabbedMesh contourInSlabs(const Input& input, const ContourOptions& options,
                                         const std::filesystem::path& output, const MeshWriteOptions& write,
                                         const Monitor& monitor);

}  // namespace pdc
