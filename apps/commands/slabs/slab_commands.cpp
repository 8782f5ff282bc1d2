#include "commands/slabs/slab_commands.h"

#include "terminal/numbers.h"
#include "terminal/settings.h"

namespace pdc {
namespace {

constexpr int kMostSlabs = 99999;
constexpr int kMostThreads = 1024;

void addFolder(CLI::App& command, SlabsRequest& request) {
  command.add_option("FOLDER", request.folder, "Made by pdc plan")->required()->type_name("");
}

void addJson(CLI::App& command, SlabsRequest& request) {
  command.add_option("--json", request.json, "Report for programs; - is standard output")->type_name("FILE");
}

void addQuiet(CLI::App& command, SlabsRequest& request) {
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar");
}

}  // namespace

SlabCommands::SlabCommands(CLI::App& app)
    : mPlanCommand(app.add_subcommand("plan", "Cut a volume into slabs that can be contoured one by one")),
      mRunCommand(app.add_subcommand("run", "Contour the slabs of a plan that nobody has contoured")),
      mMergeCommand(app.add_subcommand("merge", "Join the slabs of a plan to the mesh of the whole")),
      mStatusCommand(app.add_subcommand("status", "Say how far the slabs of a plan are")) {
  addPlanOptions(*mPlanCommand, mPlan.mesh, mPlan.folder);
  addInteger(*mPlanCommand, "--slabs", mPlan.slabs, 1, kMostSlabs,
             "So many slabs, or one for each layer of 8 voxels (as few as\nfit into --max-memory)")
      ->type_name("N");
  mPlanCommand->footer("Example: pdc plan big.vdb slabs --max-memory 8GB");

  addFolder(*mRunCommand, mSlabs);
  CLI::Option* const slab =
      mRunCommand->add_option("--slab", mSlabs.slab, "Only this one, or these, from 0 (all)")->type_name("A[-B]");
  mRunCommand->add_flag("--next", mSlabs.next, "Only the next that nobody has taken")->excludes(slab);
  addInteger(*mRunCommand, "--threads", mSlabs.threads, 1, kMostThreads, "Threads (all)")->type_name("N");
  addJson(*mRunCommand, mSlabs);
  addQuiet(*mRunCommand, mSlabs);
  mRunCommand->footer("Example: pdc run slabs --next");

  addFolder(*mMergeCommand, mSlabs);
  mMergeCommand->add_option("OUTPUT", mSlabs.output, "A .ply")->required()->type_name("");
  addJson(*mMergeCommand, mSlabs);
  addQuiet(*mMergeCommand, mSlabs);
  mMergeCommand->footer("Example: pdc merge slabs big.ply");

  addFolder(*mStatusCommand, mSlabs);
  addJson(*mStatusCommand, mSlabs);
  mStatusCommand->footer("Example: pdc status slabs --json -");
}

void SlabCommands::run() const {
  if (mPlanCommand->parsed()) runPlan(mPlan, givenArguments(*mPlanCommand));
  if (mRunCommand->parsed()) runRun(mSlabs);
  if (mMergeCommand->parsed()) runMerge(mSlabs);
  if (mStatusCommand->parsed()) runStatus(mSlabs);
}

}  // namespace pdc
