#include "files/json_file.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <string>

#include "io/file/atomic_file.h"
#include "io/file/file_error.h"

namespace pdc {
namespace {

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return std::filesystem::absolute(a).lexically_normal() == std::filesystem::absolute(b).lexically_normal() ||
         std::filesystem::equivalent(a, b, ignored);
}

/// What reportOptions() was told.
nlohmann::ordered_json& reportedOptions() {
  static nlohmann::ordered_json options;
  return options;
}

nlohmann::ordered_json withOptions(nlohmann::ordered_json json) {
  if (!reportedOptions().empty()) json["options"] = reportedOptions();
  return json;
}

}  // namespace

void reportOptions(const std::vector<std::pair<std::string, std::string>>& options) {
  for (const auto& [name, value] : options) reportedOptions()[name] = value;
}

void checkJsonPath(const std::filesystem::path& path) {
  if (!path.empty() && path != "-") detail::checkWritable(path);
}

void checkJsonReplaces(const std::filesystem::path& json, const std::filesystem::path& input,
                       const std::filesystem::path& output) {
  if (json.empty() || json == "-") return;
  if (sameFile(json, input)) throw CLI::ValidationError("--json", "would replace INPUT");
  if (sameFile(json, output)) throw CLI::ValidationError("--json", "would replace OUTPUT");
}

void writeJson(const nlohmann::ordered_json& json, const std::filesystem::path& path) {
  // File names need not be UTF-8; JSON has to be.
  writeText(withOptions(json).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n", path);
}

std::string jsonLine(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void JsonLines::add(const nlohmann::ordered_json& json) {
  if (mPath.empty()) return;
  const std::string line = jsonLine(withOptions(json)) + "\n";
  if (mPath == "-") {
    fmt::print("{}", line);
    std::fflush(stdout);
    return;
  }
  // Without a buffer each line is written as one.
  if (!mFile.is_open()) {
    mFile.rdbuf()->pubsetbuf(nullptr, 0);
    mFile.open(mPath, std::ios::binary | std::ios::trunc);
  }
  if (!mFile.write(line.data(), static_cast<std::streamsize>(line.size())).flush())
    throw detail::fileError(mPath, "cannot be written", errno);
}

void writeText(const std::string& text, const std::filesystem::path& path) {
  if (path.empty()) return;
  if (path == "-") {
    fmt::print("{}", text);
    return;
  }
  detail::AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace pdc
