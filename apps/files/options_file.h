#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace pdc {

/// Adds --options and --save-options to a command.
void addOptionsFile(CLI::App& command);

/// Writes the options that a command was given, those of a file of options too, to the file that --save-options names.
/// \throws Error.
void saveGivenOptions(const CLI::App& command);

/// Arguments with those of the file that --options names in its place: a map of long names, without the dashes, and
/// values; true is a flag, a list gives each of its values. What the arguments say themselves comes before what the
/// file says. \param arguments without the program's name. \throws Error for files that cannot be read, naming the
/// line.
[[nodiscard]] std::vector<std::string> withOptionsFile(const CLI::App& app, std::vector<std::string> arguments);

/// What the arguments have that the program does not know, in a line, with what was meant perhaps: a command, or an
/// option of it. Empty if there is nothing of the kind.
[[nodiscard]] std::string unknownWord(const CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace pdc
