#include "tiles/planned_request.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "pdc/error.h"
#include "tiles/input_identity.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

}  // namespace

std::string plannedText(const fs::path& input, const std::vector<std::string>& arguments,
                        const PlannedRequest& planned) {
  return Json{{"pdc", PDC_VERSION},
              {"input", fs::absolute(input).lexically_normal().string()},
              {"identity", inputIdentity(input)},
              {"options", arguments},
              {"space", planned.space},
              {"unit", planned.unit}}
      .dump();
}

PlannedRequest plannedRequest(const std::string& text) {
  PlannedRequest planned;
  try {
    const Json json = Json::parse(text);
    if (const auto version = json.at("pdc").get<std::string>(); version != PDC_VERSION)
      throw Error(fmt::format("planned by pdc {}, this is {}; plan it again", version, PDC_VERSION));
    const auto input = json.at("input").get<std::string>();
    checkIdentity(input, json.at("identity"));
    // The parser takes them from the back.
    std::vector<std::string> arguments = json.at("options").get<std::vector<std::string>>();
    arguments.insert(arguments.begin(), {input, "slabs.ply"});
    std::reverse(arguments.begin(), arguments.end());
    CLI::App command;
    addMeshOptions(command, planned.mesh);
    command.parse(std::move(arguments));
    planned.space = json.at("space").get<std::string>();
    planned.unit = json.at("unit").get<std::string>();
  } catch (const Json::exception&) {
    throw Error("the plan does not say what it is of");
  }
  return planned;
}

MeshWriteOptions writeOptions(const PlannedRequest& planned) {
  const MeshRequest& mesh = planned.mesh;
  return {.ascii = mesh.ascii,
          .doublePrecision = mesh.doublePrecision,
          .space = planned.space,
          .unit = mesh.unit.empty() ? planned.unit : mesh.unit,
          .source = mesh.input.filename().string(),
          .settings = mesh.settings};
}

}  // namespace pdc
