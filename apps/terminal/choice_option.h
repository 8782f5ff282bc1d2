#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pdc {

/// The words that an option takes, in the order of the help text, and what they stand for.
template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// The word for a value, which has one.
template <typename Value>
[[nodiscard]] std::string wordOf(const Choices<Value>& choices, Value value) {
  for (const auto& [word, other] : choices)
    if (other == value) return word;
  return "";
}

/// An option that takes one of these words. Another one is a usage error that lists them.
template <typename Value, typename Target>
CLI::Option* addChoice(CLI::App& command, const std::string& name, Target& target, const Choices<Value>& choices,
                       const std::string& help) {
  const auto take = [&target, choices](const std::string& text) {
    for (const auto& [word, value] : choices)
      if (word == text) target = value;
  };
  return command.add_option_function<std::string>(name, take, help)->check(CLI::IsMember(choices));
}

}  // namespace pdc
