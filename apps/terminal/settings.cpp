#include "terminal/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace pdc {
namespace {

constexpr std::array<std::string_view, 8> kNotSettings{"help",       "threads", "quiet",   "json",
                                                       "max-memory", "format",  "options", "save-options"};

}  // namespace

std::vector<std::pair<std::string, std::string>> givenSettings(const CLI::App& command) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = option->get_lnames().front();
    if (std::find(kNotSettings.begin(), kNotSettings.end(), name) != kNotSettings.end()) continue;
    const bool isFlag = option->get_items_expected_max() == 0;
    settings.emplace_back(name, isFlag ? "true" : fmt::format("{}", fmt::join(option->results(), ",")));
  }
  return settings;
}

std::string settingsText(const CLI::App& command) {
  std::string text;
  for (const auto& [name, value] : givenSettings(command))
    text += fmt::format("{}--{}{}", text.empty() ? "" : " ", name, value == "true" ? "" : " " + value);
  return text;
}

}  // namespace pdc
