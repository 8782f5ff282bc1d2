#pragma once

#include <filesystem>

#include "pdc/mesh/mesh.h"

/// Errors of these functions do not name the file: their callers do.
namespace pdc::detail {

/// A descriptor of a regular file that is not empty, to be closed by the caller. \throws Error for any other path.
[[nodiscard]] int openForReading(const std::filesystem::path& path);

/// All bytes of a regular file that is not empty. \throws Error for any other path, and if reading fails.
[[nodiscard]] Buffer<char> readFile(const std::filesystem::path& path);

}  // namespace pdc::detail
