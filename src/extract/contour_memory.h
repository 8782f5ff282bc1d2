#pragma once

#include <string>

#include "pdc/error.h"
#include "pdc/extract/contour.h"

namespace pdc::detail {

/// Bytes for the signs and topology of a block, and what is noted of it.
inline constexpr double kBlockMemory = 800;

/// Bytes that contouring takes beyond what the source has in use, the mesh included: measured on
/// spheres and noise of 128³ to 2048³ voxels, whose peaks grow by 50 to 60 bytes per vertex where nothing is asked for
/// beside the mesh.
[[nodiscard]] double contourMemory(double vertices, const ContourOptions& options);

/// What checkMemory() throws.
class TooLarge : public Error {
 public:
  using Error::Error;
};

/// \throws TooLarge with both figures if so many bytes more do not fit into options.maxMemory, or into the machine.
void checkMemory(double bytes, double vertices, const ContourOptions& options);

/// Gives the system back what was freed and is kept: until then it counts as in use.
void giveBackMemory();

/// "512", "2.5 million", "25.7 billion".
[[nodiscard]] std::string countText(double count);
/// "5 kB", "120 MB", "16 GB", "198 TB".
[[nodiscard]] std::string bytesText(double bytes);

}  // namespace pdc::detail
