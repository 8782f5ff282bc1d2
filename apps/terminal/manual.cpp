#include "terminal/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "pdc/error.h"

namespace pdc {
namespace {

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  // An empty group hides a command, as it does an option.
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

bool isShown(const CLI::Option* option) { return !option->get_group().empty(); }

/// Text as troff takes it: dashes to copy, and no line that begins a request.
std::string troff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) {
      out += fmt::format("\\&{}", c);
    } else {
      out += c;
    }
  }
  return out;
}

/// A description in one line.
std::string oneParagraph(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The words that an option takes, from the "{a,b,c}" of its type's name; empty where any value will do.
std::vector<std::string> wordsOf(const CLI::Option* option) {
  const std::string type = option->get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  for (std::size_t at = begin + 1; at < end;) {
    const std::size_t next = std::min(type.find(',', at), end);
    words.push_back(type.substr(at, next - at));
    at = next + 1;
  }
  return words;
}

/// "--sigma-n S|inf|auto", or an argument's name.
std::string usageOf(const CLI::Option* option) {
  if (option->get_positional()) return fmt::format("\\fI{}\\fR", troff(option->get_name(true)));
  std::string text;
  for (const std::string& name : option->get_snames()) text += fmt::format("\\fB\\-{}\\fR, ", troff(name));
  for (const std::string& name : option->get_lnames()) text += fmt::format("\\fB\\-\\-{}\\fR, ", troff(name));
  text.resize(text.size() - 2);
  const std::string type = option->get_type_name();
  const bool isFlag = option->get_items_expected_max() == 0;
  return isFlag || type.empty() ? text : fmt::format("{} \\fI{}\\fR", text, troff(type));
}

std::string entryOf(const CLI::Option* option) {
  return fmt::format(".TP\n{}\n{}.\n", usageOf(option), troff(oneParagraph(option->get_description())));
}

std::string optionsOf(const CLI::App& command) {
  std::string text, group;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) text += (text.empty() ? ".SH ARGUMENTS\n" : "") + entryOf(option);
  text += ".SH OPTIONS\n";
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() || !isShown(option)) continue;
    if (option->get_group() != group) text += fmt::format(".SS \"{}\"\n", troff(option->get_group()));
    group = option->get_group();
    text += entryOf(option);
  }
  return text;
}

std::string upperCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

constexpr std::string_view kExitStatus =
    ".SH EXIT STATUS\n0 done, 1 failed or, of a check, not clean, 2 wrong usage, 130 interrupted.\n";

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) throw Error(fmt::format("{}: cannot be written", path.string()));
}

std::string longNames(const CLI::App& command) {
  std::string names;
  for (const CLI::Option* option : command.get_options())
    if (isShown(option))
      for (const std::string& name : option->get_lnames())
        names += fmt::format("{}--{}", names.empty() ? "" : " ", name);
  return names;
}

}  // namespace

std::string manualPage(const CLI::App& app, const CLI::App& command) {
  const bool isProgram = &app == &command;
  const std::string name = isProgram ? app.get_name() : fmt::format("{}-{}", app.get_name(), command.get_name());
  std::string text = fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                                 upperCase(name), app.version(), troff(name), troff(command.get_description()));
  if (isProgram) {
    text += fmt::format(".B {} \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n.SH COMMANDS\n", app.get_name());
    for (const CLI::App* one : commandsOf(app))
      text += fmt::format(".TP\n\\fB{}\\fR\n{}; see \\fB{}\\-{}\\fR(1).\n", one->get_name(),
                          troff(one->get_description()), app.get_name(), one->get_name());
    return text + std::string(kExitStatus);
  }
  text += fmt::format(".B {} {}\n[\\fIOPTIONS\\fR]", app.get_name(), command.get_name());
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) text += " " + usageOf(option);
  text += "\n" + optionsOf(command) + std::string(kExitStatus);
  constexpr std::string_view kExample = "Example: ";
  if (const std::size_t at = command.get_footer().find(kExample); at != std::string::npos)
    text += fmt::format(".SH EXAMPLE\n.nf\n{}\n.fi\n", troff(command.get_footer().substr(at + kExample.size())));
  return text + fmt::format(".SH SEE ALSO\n\\fB{}\\fR(1)\n", app.get_name());
}

std::string bashCompletion(const CLI::App& app) {
  std::string commands, options, words;
  for (const CLI::App* command : commandsOf(app)) {
    commands += fmt::format("{}{}", commands.empty() ? "" : " ", command->get_name());
    options += fmt::format("    {}) words='{}' ;;\n", command->get_name(), longNames(*command));
    for (const CLI::Option* option : command->get_options())
      if (const auto taken = wordsOf(option); !taken.empty() && !option->get_lnames().empty())
        words += fmt::format("    '{} --{}') words='{}' ;;\n", command->get_name(), option->get_lnames().front(),
                             fmt::join(taken, " "));
  }
  return fmt::format(R"(# Completion of {0} for bash.
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=''
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W '{1} --help --version' -- "$word")
    return
  fi
  case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD - 1]}}" in
{3}  esac
  if [[ -z "$words" && "$word" == -* ]]; then
    case "${{COMP_WORDS[1]}}" in
{2}    esac
  fi
  if [[ -n "$words" ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _{0} {0}
)",
                     app.get_name(), commands, options, words);
}

void writeManual(const CLI::App& app, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(fmt::format("{}: {}", folder.string(), error.message()));
  write(folder / (app.get_name() + ".1"), manualPage(app, app));
  for (const CLI::App* command : commandsOf(app))
    write(folder / fmt::format("{}-{}.1", app.get_name(), command->get_name()), manualPage(app, *command));
  write(folder / (app.get_name() + ".bash"), bashCompletion(app));
}

}  // namespace pdc
