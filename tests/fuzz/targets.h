#pragma once

#include <filesystem>
#include <string_view>

namespace pdc {

// What fuzzers feed bytes to. Each reads the bytes as a file and contours what is in it, coarsely; a mesh that is not
// closed and manifold ends the process. \throws Error where the bytes are refused.

void fuzzScene(std::string_view bytes);
void fuzzVdb(std::string_view bytes);
/// Takes the bytes as the format that they begin as.
void fuzzVolume(std::string_view bytes);
/// Takes .raw and .raw.gz for 10 × 10 × 10 values of 16 bits.
void fuzzVolumeFile(const std::filesystem::path& path);

}  // namespace pdc
