#pragma once

#include <filesystem>

namespace pdc {

/// What a file holds, by its suffix in any case: .vdb, .yaml or .yml, and anything else.
enum class InputKind { kGrid, kScene, kOther };

[[nodiscard]] InputKind inputKind(const std::filesystem::path& path);

}  // namespace pdc
