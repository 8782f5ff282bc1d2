#include "files/json_file.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "io/file/atomic_file.h"

namespace pdc {
namespace {

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return std::filesystem::absolute(a).lexically_normal() == std::filesystem::absolute(b).lexically_normal() ||
         std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

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
  writeText(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n", path);
}

std::string jsonLine(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
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
