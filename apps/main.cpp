#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "commands/check_command.h"
#include "commands/cluster_command.h"
#include "commands/decimate_command.h"
#include "commands/grid_command.h"
#include "commands/info_command.h"
#include "commands/mesh_command.h"
#include "commands/points/points_commands.h"
#include "commands/render_command.h"
#include "commands/smooth_command.h"
#include "commands/subdivide_command.h"
#include "commands/sweep_command.h"
#include "files/pipes.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"
#include "terminal/huge_heap.h"
#include "terminal/interrupt.h"
#include "terminal/shown_path.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

int fail(int exitCode, std::string message) {
  message = pdc::shownText(std::move(message));
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fputs(fmt::format("pdc: {}\n", message).c_str(), stderr);
  return exitCode;
}

/// Returns the exit code.
int run(int argc, char** argv) {
  CLI::App app("Turns volumes (OpenVDB grids, implicit scenes) into meshes.", "pdc");
  app.set_version_flag("--version", "pdc " PDC_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 failed (or not clean), 2 wrong usage, 130 interrupted.\n"
      "`pdc COMMAND --help` lists the options of a command.");

  pdc::MeshRequest mesh;
  CLI::App* meshCommand = app.add_subcommand("mesh", "Contour a grid or a scene and write the mesh");
  pdc::addMeshOptions(*meshCommand, mesh);
  pdc::addPipes(*meshCommand, mesh.input, &mesh.output);
  meshCommand->footer("Example: pdc mesh part.vdb part.ply --sigma-n 0.02 --json part.json");
  pdc::MeshRequest grid;
  CLI::App* gridCommand = app.add_subcommand("grid", "Clip, resample, smooth and combine a grid, and write it");
  pdc::addGridOptions(*gridCommand, grid);
  pdc::addPipes(*gridCommand, grid.input, &grid.output);
  pdc::InfoRequest info;
  CLI::App* infoCommand = app.add_subcommand("info", "Say what is in a grid file, a scene or a mesh");
  pdc::addInfoOptions(*infoCommand, info);
  pdc::addPipes(*infoCommand, info.file, nullptr);
  pdc::CheckRequest check;
  CLI::App* checkCommand = app.add_subcommand("check", "Say whether a mesh is clean, and what is wrong with it");
  pdc::addCheckOptions(*checkCommand, check);
  pdc::addPipes(*checkCommand, check.file, nullptr);
  pdc::RenderRequest render;
  CLI::App* renderCommand = app.add_subcommand("render", "Draw a mesh into a .png file");
  pdc::addRenderOptions(*renderCommand, render);
  pdc::addPipes(*renderCommand, render.mesh, &render.picture);
  pdc::DecimateRequest decimate;
  CLI::App* decimateCommand = app.add_subcommand("decimate", "Write a mesh with fewer triangles");
  pdc::addDecimateOptions(*decimateCommand, decimate);
  pdc::addPipes(*decimateCommand, decimate.input, &decimate.output);
  pdc::ClusterRequest cluster;
  CLI::App* clusterCommand = app.add_subcommand("cluster", "Write a mesh with one vertex per cell of a grid, fast");
  pdc::addClusterOptions(*clusterCommand, cluster);
  pdc::addPipes(*clusterCommand, cluster.input, &cluster.output);
  pdc::SubdivideRequest subdivide;
  CLI::App* subdivideCommand = app.add_subcommand("subdivide", "Refine a mesh into a smooth surface");
  pdc::addSubdivideOptions(*subdivideCommand, subdivide);
  pdc::addPipes(*subdivideCommand, subdivide.input, &subdivide.output);
  pdc::SmoothRequest smooth;
  CLI::App* smoothCommand = app.add_subcommand("smooth", "Write a mesh without its noise, creases kept");
  pdc::addSmoothOptions(*smoothCommand, smooth);
  pdc::addPipes(*smoothCommand, smooth.input, &smooth.output);
  const pdc::PointsCommands points(app);
  pdc::SweepRequest sweep;
  CLI::App* sweepCommand = app.add_subcommand("sweep", "Contour for several values and compare, with pictures");
  pdc::addSweepOptions(*sweepCommand, sweep);
  pdc::addPipes(*sweepCommand, sweep.mesh.input, nullptr);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    app.exit(help);
    return kDone;
  }
  if (meshCommand->parsed()) pdc::runMesh(mesh);
  if (gridCommand->parsed()) pdc::runGrid(grid);
  if (infoCommand->parsed()) pdc::runInfo(info);
  if (checkCommand->parsed() && !pdc::runCheck(check)) return kFailed;
  if (renderCommand->parsed()) pdc::runRender(render);
  if (decimateCommand->parsed()) pdc::runDecimate(decimate);
  if (clusterCommand->parsed()) pdc::runCluster(cluster);
  if (subdivideCommand->parsed()) pdc::runSubdivide(subdivide);
  if (smoothCommand->parsed()) pdc::runSmooth(smooth);
  points.run();
  if (sweepCommand->parsed()) pdc::runSweep(sweep, pdc::commandLine({argv + 1, argv + argc}));
  return kDone;
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
