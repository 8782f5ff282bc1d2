#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pdc {

/// The options of a command that were given and say what is made, by their long names: not those that say how (as
/// --threads), what is shown meanwhile, and where reports go. Flags are "true".
[[nodiscard]] std::vector<std::pair<std::string, std::string>> givenSettings(const CLI::App& command);

/// The same as arguments that another run can be given.
[[nodiscard]] std::vector<std::string> givenArguments(const CLI::App& command);

/// The same as a command line has them, such as "--sigma-n 0.05 --triangles".
[[nodiscard]] std::string settingsText(const CLI::App& command);

}  // namespace pdc
