#pragma once

#include <filesystem>
#include <string>

namespace pdc {

// What comes through a pipe lies in a file of ours meanwhile, which users do not know.

/// Shows `name` in place of a path from now on. Not for several threads.
void showPathAs(const std::filesystem::path& path, const std::string& name);

/// A path as users know it.
[[nodiscard]] std::string shownPath(const std::filesystem::path& path);

/// A message with paths as users know them.
[[nodiscard]] std::string shownText(std::string message);

}  // namespace pdc
