#pragma once

#include <filesystem>

namespace pdc::detail {

enum class MeshFormat { kPly, kObj, kStl, kOff };

/// By suffix, in any case. \throws Error for any other suffix, naming those that are known.
[[nodiscard]] MeshFormat meshFormat(const std::filesystem::path& path);

}  // namespace pdc::detail
