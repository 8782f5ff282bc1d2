#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace pdc {

/// The manual page (section 1) of the program or of one of its commands, as troff reads it.
[[nodiscard]] std::string manualPage(const CLI::App& app, const CLI::App& command);

/// What makes bash complete commands, options and the words that options take.
[[nodiscard]] std::string bashCompletion(const CLI::App& app);

/// Writes all of it into a folder, which is made if need be: pdc.1, pdc-COMMAND.1 and pdc.bash. \throws Error.
void writeManual(const CLI::App& app, const std::filesystem::path& folder);

}  // namespace pdc
