#include "files/options_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "files/json_file.h"
#include "io/file/closest_word.h"
#include "pdc/error.h"
#include "terminal/settings.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

const CLI::App* commandOf(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return nullptr;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const CLI::App* c) { return c->get_name() == arguments.front(); });
  return found == commands.end() ? nullptr : *found;
}

/// "--sigma-n" of "--sigma-n=0.05"; empty for what is no long option.
std::string longName(const std::string& argument) {
  if (!argument.starts_with("--") || argument.size() == 2) return "";
  return argument.substr(0, argument.find('='));
}

std::vector<std::string> longNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// Takes the value of an option out of arguments, if it is there.
std::optional<std::string> take(std::vector<std::string>& arguments, const std::string& name) {
  for (auto it = arguments.begin(); it != arguments.end(); ++it) {
    if (longName(*it) != name) continue;
    if (it->size() > name.size()) {
      const std::string value = it->substr(name.size() + 1);
      arguments.erase(it);
      return value;
    }
    if (it + 1 == arguments.end()) return std::nullopt;
    const std::string value = *(it + 1);
    arguments.erase(it, it + 2);
    return value;
  }
  return std::nullopt;
}

[[noreturn]] void fail(const fs::path& path, const YAML::Mark& mark, const std::string& what) {
  throw Error(fmt::format("{}:{}: {}", path.string(), mark.line + 1, what));
}

YAML::Node load(const fs::path& path) {
  try {
    const YAML::Node file = YAML::LoadFile(path.string());
    if (!file.IsMap()) throw Error(fmt::format("{}: is not a map of options and their values", path.string()));
    return file;
  } catch (const YAML::BadFile&) {
    throw Error(fmt::format("{}: cannot be opened", path.string()));
  } catch (const YAML::Exception& error) {
    fail(path, error.mark, error.msg);
  }
}

/// The arguments that a line of the file stands for.
std::vector<std::string> argumentsOf(const CLI::Option& option, const std::string& name, const YAML::Node& value,
                                     const fs::path& path) {
  const bool isFlag = option.get_items_expected_max() == 0;
  if (isFlag) {
    bool set = false;
    if (!value.IsScalar() || !YAML::convert<bool>::decode(value, set))
      fail(path, value.Mark(), fmt::format("{} is true or false", name.substr(2)));
    return set ? std::vector{name} : std::vector<std::string>{};
  }
  if (value.IsScalar()) return {name + "=" + value.Scalar()};
  std::vector<std::string> values;
  bool scalars = value.IsSequence();
  if (scalars)
    for (const YAML::Node& one : value) {
      scalars = scalars && one.IsScalar();
      if (one.IsScalar()) values.push_back(one.Scalar());
    }
  if (!scalars) fail(path, value.Mark(), fmt::format("{} is a value or a list of values", name.substr(2)));
  if (option.get_items_expected_max() <= 1) return {fmt::format("{}={}", name, fmt::join(values, ","))};
  std::vector<std::string> arguments;
  for (const std::string& one : values) arguments.push_back(name + "=" + one);
  return arguments;
}

}  // namespace

void addOptionsFile(CLI::App& command) {
  const auto group = "Files of options";
  // Only withOptionsFile() sees this one.
  command.add_option("--options", "A .yaml of long names and values; what is given besides comes first")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--save-options", "Write the options that were given, for --options")
      ->type_name("FILE")
      ->group(group);
}

void saveGivenOptions(const CLI::App& command) {
  const CLI::Option* const saved = command.get_option("--save-options");
  if (saved->count() == 0) return;
  YAML::Emitter file;
  file << YAML::BeginMap;
  for (const auto& [name, value] : givenSettings(command)) file << YAML::Key << name << YAML::Value << value;
  file << YAML::EndMap;
  writeText(fmt::format("# Options of pdc {}\n{}\n", command.get_name(), file.c_str()), saved->as<std::string>());
}

std::vector<std::string> withOptionsFile(const CLI::App& app, std::vector<std::string> arguments) {
  const CLI::App* const command = commandOf(app, arguments);
  if (command == nullptr) return arguments;
  const std::optional<std::string> path = take(arguments, "--options");
  if (!path) return arguments;
  const std::vector<std::string> known = longNames(*command);
  std::vector<std::string> added;
  for (const auto& entry : load(*path)) {
    const std::string name = entry.first.IsScalar() ? "--" + entry.first.Scalar() : "";
    if (std::find(known.begin(), known.end(), name) == known.end() || name == "--options")
      fail(*path, entry.first.Mark(),
           fmt::format("'{}' is no option of pdc {}{}", name.empty() ? "" : name.substr(2), command->get_name(),
                       detail::didYouMean(name, known)));
    const bool given = std::any_of(arguments.begin(), arguments.end(),
                                   [&](const std::string& argument) { return longName(argument) == name; });
    if (given) continue;
    for (std::string& argument : argumentsOf(*command->get_option(name), name, entry.second, *path))
      added.push_back(std::move(argument));
  }
  arguments.insert(arguments.begin() + 1, added.begin(), added.end());
  return arguments;
}

std::string unknownWord(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return "";
  const CLI::App* const command = commandOf(app, arguments);
  if (command == nullptr) {
    if (arguments.front().starts_with('-')) return "";
    std::vector<std::string> names;
    for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(one->get_name());
    return fmt::format("there is no command '{}'{}", arguments.front(), detail::didYouMean(arguments.front(), names));
  }
  const std::vector<std::string> known = longNames(*command);
  for (const std::string& argument : arguments) {
    const std::string name = longName(argument);
    if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) continue;
    return fmt::format("there is no option '{}' of pdc {}{}", name, command->get_name(),
                       detail::didYouMean(name, known));
  }
  return "";
}

}  // namespace pdc
