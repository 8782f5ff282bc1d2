#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace pdc {

/// \throws Error unless a report can be written to `path`. An empty path (no report) and "-" (standard output) always
/// serve.
void checkJsonPath(const std::filesystem::path& path);

/// A report must not take the place of a command's input or output. An empty path, and "-", always serve.
/// \throws CLI::ValidationError.
void checkJsonReplaces(const std::filesystem::path& json, const std::filesystem::path& input,
                       const std::filesystem::path& output);

/// Writes to a file, which appears only when it is complete, or to standard output for "-"; does nothing for an empty
/// path.
void writeJson(const nlohmann::ordered_json& json, const std::filesystem::path& path);

/// A report in one line, without its end.
[[nodiscard]] std::string jsonLine(const nlohmann::ordered_json& json);

/// Writes text likewise, as it is.
void writeText(const std::string& text, const std::filesystem::path& path);

}  // namespace pdc
