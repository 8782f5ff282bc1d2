#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/check_command.h"
#include "commands/cluster_command.h"
#include "commands/decimate_command.h"
#include "commands/grid_command.h"
#include "commands/info_command.h"
#include "commands/mesh_command.h"
#include "commands/pictures/render_command.h"
#include "commands/pictures/view_command.h"
#include "commands/points/points_commands.h"
#include "commands/slabs/slab_commands.h"
#include "commands/smooth_command.h"
#include "commands/subdivide_command.h"
#include "commands/sweep_command.h"
#include "files/json_file.h"
#include "files/options_file.h"
#include "files/pipes.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"
#include "terminal/huge_heap.h"
#include "terminal/interrupt.h"
#include "terminal/manual.h"
#include "terminal/settings.h"
#include "terminal/shown_path.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

int fail(int exitCode, std::string message) {
  message = pdc::shownText(std::move(message));
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fputs(fmt::format("pdc: {}\n", message).c_str(), stderr);
  return exitCode;
}

/// All commands of the program.
class Commands {
 public:
  Commands(CLI::App& app, std::string commandLine) : mApp(app), mCommandLine(std::move(commandLine)) {
    addThoseOfVolumes();
    addThoseOfMeshes();
    mPoints.emplace(app);
    mSlabs.emplace(app);
    for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
      pdc::addOptionsFile(*command);
    // For those who make packages.
    mManualCommand =
        app.add_subcommand("manual", "Write manual pages and what makes bash complete commands")->group("");
    mManualCommand->add_option("FOLDER", mManualFolder)->required();
  }

  /// Runs the one that was given. \returns the exit code.
  [[nodiscard]] int run() const {
    const CLI::App& given = *mApp.get_subcommands().front();
    if (&given != mManualCommand) pdc::saveGivenOptions(given);
    pdc::reportOptions(pdc::givenSettings(given));
    for (const auto& [command, runIt] : mRuns)
      if (command->parsed()) return runIt();
    mPoints->run();
    mSlabs->run();
    if (mManualCommand->parsed()) pdc::writeManual(mApp, mManualFolder);
    return kDone;
  }

 private:
  template <typename Run>
  CLI::App& add(const char* name, const char* help, const Run& run) {
    CLI::App* const command = mApp.add_subcommand(name, help);
    mRuns.emplace_back(command, [run] {
      run();
      return kDone;
    });
    return *command;
  }

  void addThoseOfVolumes() {
    CLI::App& mesh = add("mesh", "Contour a grid or a scene and write the mesh", [this] { pdc::runMesh(mMesh); });
    pdc::addMeshOptions(mesh, mMesh);
    pdc::addPipes(mesh, mMesh.input, &mMesh.output);
    mesh.footer("Example: pdc mesh part.vdb part.ply --sigma-n 0.02 --json part.json");
    CLI::App& grid =
        add("grid", "Clip, resample, smooth and combine a grid, and write it", [this] { pdc::runGrid(mGrid); });
    pdc::addGridOptions(grid, mGrid);
    pdc::addPipes(grid, mGrid.input, &mGrid.output);
    CLI::App& info = add("info", "Say what is in a grid file, a scene or a mesh", [this] { pdc::runInfo(mInfo); });
    pdc::addInfoOptions(info, mInfo);
    pdc::addPipes(info, mInfo.file, nullptr);
    CLI::App& sweep = add("sweep", "Contour for several values and compare, with pictures",
                          [this] { pdc::runSweep(mSweep, mCommandLine); });
    pdc::addSweepOptions(sweep, mSweep);
    pdc::addPipes(sweep, mSweep.mesh.input, nullptr);
  }

  void addThoseOfMeshes() {
    CLI::App* const check = mApp.add_subcommand("check", "Say whether a mesh is clean, and what is wrong with it");
    mRuns.emplace_back(check, [this] { return pdc::runCheck(mCheck) ? kDone : kFailed; });
    pdc::addCheckOptions(*check, mCheck);
    pdc::addPipes(*check, mCheck.file, nullptr);
    CLI::App& render = add("render", "Draw a mesh into a .png file", [this] { pdc::runRender(mRender); });
    pdc::addRenderOptions(render, mRender);
    pdc::addPipes(render, mRender.mesh, &mRender.picture);
    CLI::App& view = add("view", "Write a page to look at a mesh in a browser", [this] { pdc::runView(mView); });
    pdc::addViewOptions(view, mView);
    pdc::addPipes(view, mView.mesh, &mView.page);
    CLI::App& decimate = add("decimate", "Write a mesh with fewer triangles", [this] { pdc::runDecimate(mDecimate); });
    pdc::addDecimateOptions(decimate, mDecimate);
    pdc::addPipes(decimate, mDecimate.input, &mDecimate.output);
    CLI::App& cluster =
        add("cluster", "Write a mesh with one vertex per cell of a grid, fast", [this] { pdc::runCluster(mCluster); });
    pdc::addClusterOptions(cluster, mCluster);
    pdc::addPipes(cluster, mCluster.input, &mCluster.output);
    CLI::App& subdivide =
        add("subdivide", "Refine a mesh into a smooth surface", [this] { pdc::runSubdivide(mSubdivide); });
    pdc::addSubdivideOptions(subdivide, mSubdivide);
    pdc::addPipes(subdivide, mSubdivide.input, &mSubdivide.output);
    CLI::App& smooth =
        add("smooth", "Write a mesh without its noise, creases kept", [this] { pdc::runSmooth(mSmooth); });
    pdc::addSmoothOptions(smooth, mSmooth);
    pdc::addPipes(smooth, mSmooth.input, &mSmooth.output);
  }

  CLI::App& mApp;
  std::string mCommandLine;
  std::vector<std::pair<CLI::App*, std::function<int()>>> mRuns;
  pdc::MeshRequest mMesh, mGrid;
  pdc::InfoRequest mInfo;
  pdc::SweepRequest mSweep;
  pdc::CheckRequest mCheck;
  pdc::RenderRequest mRender;
  pdc::ViewRequest mView;
  pdc::DecimateRequest mDecimate;
  pdc::ClusterRequest mCluster;
  pdc::SubdivideRequest mSubdivide;
  pdc::SmoothRequest mSmooth;
  std::optional<pdc::PointsCommands> mPoints;
  std::optional<pdc::SlabCommands> mSlabs;
  CLI::App* mManualCommand = nullptr;
  std::filesystem::path mManualFolder;
};

/// Returns the exit code.
int run(int argc, char** argv) {
  CLI::App app("Turns volumes (OpenVDB grids, dense volumes, implicit scenes, points) into meshes.", "pdc");
  app.set_version_flag("--version", "pdc " PDC_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 failed (or not clean), 2 wrong usage, 130 interrupted.\n"
      "`pdc COMMAND --help` lists the options of a command.");
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const Commands commands(app, pdc::commandLine(arguments));
  if (const std::string unknown = pdc::unknownWord(app, arguments); !unknown.empty())
    return fail(kUsage, unknown + " (see pdc --help)");
  arguments = pdc::withOptionsFile(app, std::move(arguments));
  std::reverse(arguments.begin(), arguments.end());  // As the parser takes them.
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::Success& help) {
    app.exit(help);
    return kDone;
  }
  return commands.run();
}

}  // namespace

int main(int argc, char** argv) {
  pdc::useHugePagesForHeap();
  pdc::installInterruptHandler();
  try {
    const int exitCode = run(argc, argv);
    pdc::finishPipes();
    if (std::fflush(stdout) != 0) return fail(kFailed, "cannot write to standard output");
    return exitCode;
  } catch (const CLI::ParseError& e) {
    return fail(kUsage, std::string(e.what()) + " (see pdc --help)");
  } catch (const pdc::Cancelled&) {
    std::fputs(pdc::kInterruptedMessage.data(), stderr);
    return pdc::kInterruptedExitCode;
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "out of memory: " + pdc::detail::memoryFigures());
  } catch (const std::exception& e) {
    return fail(kFailed, e.what());
  }
}
