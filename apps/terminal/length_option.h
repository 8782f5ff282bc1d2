#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "pdc/simplify/decimate.h"

namespace pdc {

/// A length like "0.5", in world units, or like "2v", in others that its suffix stands for.
struct SuffixedLength {
  double value;
  bool suffixed;
};

/// Nothing if the text is no such length, or is not above 0 and finite.
[[nodiscard]] std::optional<SuffixedLength> parseLength(const std::string& text, char suffix);

/// An option that takes a length, with the suffix `L` in mean edge lengths of a mesh. What is refused is a usage error
/// that names the option and the text.
CLI::Option* addLength(CLI::App& command, const std::string& name, std::optional<MeshLength>& target,
                       const std::string& help);
/// The same, with the suffix `v` in voxels.
CLI::Option* addVoxelLength(CLI::App& command, const std::string& name, std::optional<SuffixedLength>& target,
                            const std::string& help);

}  // namespace pdc
