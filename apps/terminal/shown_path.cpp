#include "terminal/shown_path.h"

#include <utility>
#include <vector>

namespace pdc {
namespace {

/// Paths and the names shown in their place.
std::vector<std::pair<std::string, std::string>>& shownNames() {
  static std::vector<std::pair<std::string, std::string>> names;
  return names;
}

}  // namespace

void showPathAs(const std::filesystem::path& path, const std::string& name) {
  shownNames().emplace_back(path.string(), name);
}

std::string shownPath(const std::filesystem::path& path) { return shownText(path.string()); }

std::string shownText(std::string message) {
  for (const auto& [path, name] : shownNames())
    for (std::size_t at = message.find(path); at != std::string::npos; at = message.find(path, at + name.size()))
      message.replace(at, path.size(), name);
  return message;
}

}  // namespace pdc
