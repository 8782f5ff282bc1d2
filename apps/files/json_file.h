#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pdc {

/// \throws Error unless a report can be written to `path`. An empty path (no report) and "-" (standard output) always
/// serve.
void checkJsonPath(const std::filesystem::path& path);

/// A report must not take the place of a command's input or output. An empty path, and "-", always serve.
/// \throws CLI::ValidationError.
void checkJsonReplaces(const std::filesystem::path& json, const std::filesystem::path& input,
                       const std::filesystem::path& output);

/// All reports written from now on say so under "options": names and values. Not for several threads.
void reportOptions(const std::vector<std::pair<std::string, std::string>>& options);

/// Writes to a file, which appears only when it is complete, or to standard output for "-"; does nothing for an empty
/// path.
void writeJson(const nlohmann::ordered_json& json, const std::filesystem::path& path);

/// A report in one line, without its end.
[[nodiscard]] std::string jsonLine(const nlohmann::ordered_json& json);

/// Reports of long work, a line for each as it comes: in a file, which is begun with the first and holds whole lines at
/// any time, or on standard output for "-"; nothing for an empty path.
class JsonLines {
 public:
  explicit JsonLines(std::filesystem::path path) : mPath(std::move(path)) {}

  /// \throws Error if it cannot be written.
  void add(const nlohmann::ordered_json& json);

 private:
  const std::filesystem::path mPath;
  std::ofstream mFile;
};

/// Writes text likewise, as it is.
void writeText(const std::string& text, const std::filesystem::path& path);

}  // namespace pdc
