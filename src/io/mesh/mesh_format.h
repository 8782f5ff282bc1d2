#pragma once

#include <filesystem>

namespace pdc::detail {

enum class MeshFormat { kPly, kObj, kStl, kOff };

/// What a file is by its suffix, in any case. \throws Error for any other suffix, naming those that are known.
[[nodiscard]] MeshFormat meshFormat(const std::filesystem::path& path);

}  // namespace pdc::detail
