#pragma once

#include <string>

#include "pdc/extract/contour.h"

namespace pdc::detail {

/// Bytes that contouring takes beyond what the source has in use, the mesh included: measured on
/// spheres and noise of 128³ to 2048³ voxels, whose peaks grow by 50 to 60 bytes per vertex where nothing is asked for
/// beside the mesh.
[[nodiscard]] double contourMemory(double vertices, const ContourOptions& options);

/// \throws Error with both figures if so many bytes more do not fit into options.maxMemory, or into the machine.
void checkMemory(double bytes, double vertices, const ContourOptions& options);

/// "512", "2.5 million", "25.7 billion".
[[nodiscard]] std::string countText(double count);
/// "5 kB", "120 MB", "16 GB", "198 TB".
[[nodiscard]] std::string bytesText(double bytes);

}  // namespace pdc::detail
