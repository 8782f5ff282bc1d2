#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "pdc/simplify/decimate.h"

namespace pdc {

/// A length like "0.5", in world units, or "2L", in mean edge lengths of a mesh; nothing if it is none, or is not above
/// 0 and finite.
[[nodiscard]] std::optional<MeshLength> parseLength(const std::string& text);

/// An option that takes such a length. What is refused is a usage error that names the option and the text.
CLI::Option* addLength(CLI::App& command, const std::string& name, std::optional<MeshLength>& target,
                       const std::string& help);

}  // namespace pdc
