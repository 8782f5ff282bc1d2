#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace pdc {

/// Lets a command take "-" for standard input and output: adds --format and --input-format, and puts files of ours in
/// their place. What comes in is kept in a temporary file, since most formats are not read from front to back; what
/// goes out is whole before its first byte does, and all else that the program says goes to standard error then.
/// \param input and \param output are the command's own; output may be null for commands that write no such file.
void addPipes(CLI::App& command, std::filesystem::path& input, std::filesystem::path* output);

/// Sends what was made for standard output there. Call it once, when all is done. \throws Error if that fails.
void finishPipes();

}  // namespace pdc
