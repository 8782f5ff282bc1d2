#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "requests/mesh_request.h"

namespace pdc {

/// What the command line of `pdc plan` says.
struct PlanRequest {
  MeshRequest mesh;
  std::filesystem::path folder;
  std::optional<int> slabs;
};

/// What the command lines of `pdc run`, `pdc merge` and `pdc status` say.
struct SlabsRequest {
  std::filesystem::path folder, output, json;
  std::string slab;  ///< "3" or "3-5"; empty: all.
  std::optional<int> threads;
  bool next = false, quiet = false;
};

/// The commands that contour a volume in slabs.
class SlabCommands {
 public:
  explicit SlabCommands(CLI::App& app);

  /// Runs the one that was given, if one of these was. \throws Error, Cancelled, CLI::ValidationError.
  void run() const;

 private:
  CLI::App *mPlanCommand, *mRunCommand, *mMergeCommand, *mStatusCommand;
  PlanRequest mPlan;
  SlabsRequest mSlabs;
};

/// \param arguments the options given, for who runs the plan.
void runPlan(const PlanRequest& request, const std::vector<std::string>& arguments);
void runRun(const SlabsRequest& request);
void runMerge(const SlabsRequest& request);
void runStatus(const SlabsRequest& request);

}  // namespace pdc
