#include "info_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "info_facts.h"
#include "interrupt.h"
#include "json_report.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string joined;
  for (const Json& part : value) joined += (joined.empty() ? "" : " ") + text(part);
  return joined;
}

bool isList(const Json& value) { return value.is_array() && !value.empty() && value.front().is_object(); }

/// One fact a line, values in one column; a list of objects becomes a block per object.
void print(const Json& facts, const std::string& indent) {
  std::size_t width = 0;
  for (const auto& fact : facts.items()) width = std::max(width, fact.key().size());
  for (const auto& [key, value] : facts.items()) {
    if (isList(value)) {
      for (const Json& part : value) {
        fmt::print("\n");
        print(part, indent + "  ");
      }
      continue;
    }
    std::string label = key;
    std::replace(label.begin(), label.end(), '_', ' ');
    fmt::print("{}{:<{}}  {}\n", indent, label, width, text(value));
  }
}

}  // namespace

void addInfoOptions(CLI::App& command, InfoRequest& request) {
  command.add_option("FILE", request.file, ".vdb, a scene (.yaml, .yml), or a mesh: .ply, .obj, .off, .stl")
      ->required()
      ->type_name("");
  command.add_option("--json", request.json, "The same for programs; - is standard output")->type_name("FILE");
}

void runInfo(const InfoRequest& request) {
  checkJsonPath(request.json);
  const ExitOnInterrupt scope;
  const Json facts = gatherFacts(request.file);
  if (request.json.empty()) {
    print(facts, "");
  } else {
    writeJson(facts, request.json);
  }
}

}  // namespace pdc
