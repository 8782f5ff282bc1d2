#pragma once

#include <filesystem>

#include "io/parse/content.h"

namespace pdc::detail {

/// What a file is by its suffix, in any case. \throws Error for any other suffix, naming those that are known.
[[nodiscard]] MeshFormat meshFormat(const std::filesystem::path& path);

}  // namespace pdc::detail
