#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "commands/slabs/slab_commands.h"
#include "files/json_file.h"
#include "pdc/tile/slab_folder.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(SlabState::Progress progress) {
  switch (progress) {
    case SlabState::Progress::kMissing:
      return "missing";
    case SlabState::Progress::kRunning:
      return "running";
    case SlabState::Progress::kDisputed:
      return "disputed";
    case SlabState::Progress::kDone:
      return "done";
  }
  return "";
}

Json toJson(const std::vector<SlabState>& states, const SlabPlan& plan) {
  Json list = Json::array();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const SlabState& s = states[i];
    list.push_back({{"slab", i},
                    {"begin", plan.slabs[i].begin},
                    {"end", plan.slabs[i].end},
                    {"progress", nameOf(s.progress)},
                    {"runner", s.runner},
                    {"layers_about_it", s.halo},
                    {"vertices_planned", plan.slabs[i].vertices},
                    {"vertices", s.vertices},
                    {"faces", s.faces}});
  }
  return list;
}

}  // namespace

void runStatus(const SlabsRequest& request) {
  checkJsonPath(request.json);
  const SlabFolder folder(request.folder);
  const std::vector<SlabState> states = slabStates(folder);
  const auto count = [&](SlabState::Progress progress) {
    return std::count_if(states.begin(), states.end(), [&](const SlabState& s) { return s.progress == progress; });
  };
  using enum SlabState::Progress;
  writeJson({{"folder", request.folder.string()},
             {"done", count(kDone)},
             {"running", count(kRunning)},
             {"missing", count(kMissing)},
             {"disputed", count(kDisputed)},
             {"slabs", toJson(states, folder.plan())}},
            request.json);
  if (request.json == "-") return;
  fmt::print("{} slabs: {} done, {} running, {} missing, {} disputed\n", states.size(), count(kDone), count(kRunning),
             count(kMissing), count(kDisputed));
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i].progress == kRunning)
      fmt::print("slab {} is contoured by {}\n", i, states[i].runner);
    else if (states[i].progress == kDisputed)
      fmt::print("slab {} has to be contoured again\n", i);
}

}  // namespace pdc
