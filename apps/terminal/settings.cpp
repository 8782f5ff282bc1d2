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

/// Those that were given and are settings.
std::vector<const CLI::Option*> givenOptions(const CLI::App& command) {
  std::vector<const CLI::Option*> given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string& name = option->get_lnames().front();
    if (std::find(kNotSettings.begin(), kNotSettings.end(), name) == kNotSettings.end()) given.push_back(option);
  }
  return given;
}

bool isFlag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

std::string joined(const CLI::Option& option) { return fmt::format("{}", fmt::join(option.results(), ",")); }

}  // namespace

std::vector<std::pair<std::string, std::string>> givenSettings(const CLI::App& command) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const CLI::Option* option : givenOptions(command))
    settings.emplace_back(option->get_lnames().front(), isFlag(*option) ? "true" : joined(*option));
  return settings;
}

std::vector<std::string> givenArguments(const CLI::App& command) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : givenOptions(command)) {
    const std::string name = "--" + option->get_lnames().front();
    if (isFlag(*option)) {
      arguments.push_back(name);
    } else if (option->get_items_expected_max() <= 1) {
      arguments.push_back(name + "=" + joined(*option));
    } else {
      for (const std::string& one : option->results()) arguments.push_back(name + "=" + one);
    }
  }
  return arguments;
}

std::string settingsText(const CLI::App& command) {
  std::string text;
  for (const auto& [name, value] : givenSettings(command))
    text += fmt::format("{}--{}{}", text.empty() ? "" : " ", name, value == "true" ? "" : " " + value);
  return text;
}

}  // namespace pdc
