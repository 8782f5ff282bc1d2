#include "commands/mesh_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "extract/contour_memory.h"
#include "files/json_file.h"
#include "files/mesh_file.h"
#include "io/file/suffix.h"
#include "mesh/components.h"
#include "parallel/stopwatch.h"
#include "pdc/extract/contour_forecast.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "reports/json_report.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

void warn(MeshRun& run, const std::string& message) {
  run.warnings.push_back(message);
  printWarning(message);
}

void checkSurface(const MeshRequest& request, const Input& input, const Mesh& mesh, MeshRun& run) {
  if (!mesh.empty()) return;
  const std::string message = input.whyEmpty() + "; the mesh is empty";
  if (request.requireSurface) throw Error(message);
  warn(run, message);
}

/// Far from the origin the output's single precision is coarser than the vertices were placed.
void checkPrecision(const Input& input, const Mesh& mesh, MeshRun& run) {
  float farthest = 0;
  for (const Vec3f& p : mesh.positions) {
    farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  if (!std::isfinite(farthest)) throw Error("coordinates lie beyond what single precision holds, 3.4e38");
  const double spacing = std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest;
  const double inVoxels = spacing / input.source->map().voxelSize();
  if (inVoxels > kMostRounding) {
    warn(run, fmt::format("far from the origin: at coordinate {:.6g} single precision has steps of {:.2g} voxels; "
                          "--origin auto or --double keeps what is lost",
                          farthest, inVoxels));
  }
}

/// Bytes of a mesh's file, roughly.
double fileSize(const MeshRequest& request, const ContourForecast& forecast) {
  const bool text = request.ascii || detail::suffixOf(request.output) == ".obj";
  constexpr double kBinary = 29, kText = 60;  // for a vertex and a quad, as closed meshes have
  return (text ? kText : kBinary) * forecast.vertices;
}

/// Refuses what will not fit into memory before the work begins, and tells of what takes long.
void checkForecast(const MeshRequest& request, const Input& input, const MeshRun& run) {
  const auto forecast = forecastContour(*input.source, run.options, {.stop = &interruptFlag()});
  if (!forecast) return;
  detail::checkMemory(forecast->memory, forecast->vertices, run.options);
  constexpr double kMuch = 1e9;
  if (forecast->memory < kMuch || request.quiet) return;
  std::fputs(fmt::format("pdc: about {} vertices, {} of memory, a file of {}\n", detail::countText(forecast->vertices),
                         detail::bytesText(forecast->memory), detail::bytesText(fileSize(request, *forecast)))
                 .c_str(),
             stderr);
}

/// The vertices of the walls that close a scene's solid where its box cuts it off.
std::size_t countOnBox(const Input& input, const Mesh& mesh) {
  constexpr double kNear = 0.02;  // voxels
  if (!input.cut) return 0;
  const double near = kNear * input.source->map().voxelSize();
  return static_cast<std::size_t>(std::count_if(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3f& p) {
    const Vec3d world = mesh.origin + vecCast<double>(p);
    bool on = false;
    for (int axis = 0; axis < 3; ++axis)
      on = on || world[axis] < input.cut->lo[axis] + near || world[axis] > input.cut->hi[axis] - near;
    return on;
  }));
}

/// Noise about the isovalue makes thousands of closed surfaces about a lattice point or few.
void checkSpecks(const Mesh& mesh, MeshRun& run) {
  constexpr std::size_t kMany = 1000, kMostVertices = 24;
  const std::vector<std::uint32_t> sizes = detail::componentSizes(mesh);
  const auto specks = static_cast<std::size_t>(
      std::count_if(sizes.begin(), sizes.end(), [](std::size_t size) { return size <= kMostVertices; }));
  if (specks >= kMany)
    warn(run,
         fmt::format("{} of {} separate surfaces are specks of at most {} vertices; an --iso farther from the noise "
                     "or a smoothed input has fewer",
                     specks, sizes.size(), kMostVertices));
}

Mesh makeMesh(const MeshRequest& request, MeshRun& run) {
  detail::Stopwatch stopwatch;
  const Input input = [&] {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "reading " + request.input.filename().string());
    return openInput(request.input, request.inputOptions());
  }();
  run.secondsRead = stopwatch.lap();
  if (input.refusedNoise > 0)
    warn(run,
         fmt::format("{} values of the noise grids are negative or not finite; they count as 0", input.refusedNoise));
  for (const std::string& warning : input.warnings) warn(run, warning);
  run.meaning = input.meaning;
  run.crossingsWithoutData = input.crossingsWithoutData;
  run.iso = input.iso;
  run.planeOrigin = input.planeOrigin;
  run.valueNoise = input.valueNoise;
  run.options = request.contourOptions(input.sigmaNormal);
  if (request.adaptive)
    run.options.adaptive = request.adaptive->value * (request.adaptive->suffixed ? input.source->map().voxelSize() : 1);
  run.options.adaptiveScale = input.adaptiveScale;

  checkForecast(request, input, run);
  Mesh mesh;
  {
    ProgressBar bar(!request.quiet);
    const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
    mesh = contour(*input.source, run.options, &run.contour, {.progress = show, .stop = &interruptFlag()});
  }
  run.secondsContour = stopwatch.lap();
  checkSurface(request, input, mesh, run);
  checkPrecision(input, mesh, run);
  checkSpecks(mesh, run);
  run.verticesOnBox = countOnBox(input, mesh);
  return mesh;
}

/// "12 quads", "12 triangles", or both where both are there.
std::string facesText(const MeshRun& run) {
  const std::string triangles = fmt::format("{} triangles", run.triangles);
  if (run.options.triangles) return triangles;
  const std::string quads = fmt::format("{} quads", run.quads);
  return run.triangles == 0 ? quads : fmt::format("{} and {}", quads, triangles);
}

const char* phraseOf(DecidedBy by) {
  switch (by) {
    case DecidedBy::kFile:
      return "says the file";
    case DecidedBy::kType:
      return "by its type";
    case DecidedBy::kValues:
      return "by its values";
    case DecidedBy::kCaller:
      return "as asked";
  }
  return "";
}

void printSummary(const MeshRequest& request, const MeshRun& run) {
  const std::size_t open = run.contour.boundaryEdges;
  const auto boundary = open == 0 ? std::string("closed") : fmt::format("{} boundary edges", open);
  fmt::print("{}: {} vertices, {}, {}; {} bytes\n", request.output.string(), run.vertices, facesText(run), boundary,
             run.bytesWritten);
  if (run.meaning)
    fmt::print("a {} ({}), {} values inside ({})\n", nameOf(run.meaning->gridClass), phraseOf(run.meaning->classBy),
               nameOf(run.meaning->inside), phraseOf(run.meaning->insideBy));
  if (run.planeOrigin == PlaneOrigin::kDistance)
    fmt::print("planes from distances beside creases; noise of the values {:.2g} voxels\n", run.valueNoise);
  if (run.origin != Vec3d{} && !request.doublePrecision)
    fmt::print("coordinates are relative to the origin {}, {}, {}\n", run.origin.x, run.origin.y, run.origin.z);
  if (run.crossingsWithoutData > 0)
    fmt::print(
        "{} of {} crossings have weight 0 at an end and are closed all the same; --open ends the surface there\n",
        run.crossingsWithoutData, run.contour.crossings);
  if (run.verticesOnBox > 0)
    fmt::print("the solid is cut off by the box: {} vertices on it; a larger box has more of it, --open no walls\n",
               run.verticesOnBox);
  if (run.contour.creasePatches > 0 && !run.options.adaptive)
    fmt::print("{:.2g} % of the vertices on creases\n",
               1e2 * static_cast<double>(run.contour.creasePatches) / static_cast<double>(run.vertices));
  if (!run.options.sigmaNormal)
    fmt::print("sigma_n from the data: median {:.2g}; noise of the normals {:.2g}\n", run.contour.medianSigmaNormal,
               run.contour.normalNoise);
  if (run.options.adaptive)
    fmt::print(
        "{} triangles before; no point of either surface is farther than {:.4g}{} from the other, vertices {:.4g}\n",
        run.contour.trianglesBefore, *run.options.adaptive,
        request.adaptiveGrid ? fmt::format(" times '{}'", *request.adaptiveGrid) : "", run.contour.adaptedDistance);
  fmt::print("{:.2f} s: reading {:.2f}, contouring {:.2f}, writing {:.2f}\n", run.secondsTotal, run.secondsRead,
             run.secondsContour, run.secondsWrite);
}

}  // namespace

void runMesh(const MeshRequest& request) {
  checkMeshRequest(request);
  if (request.adaptiveGrid && !request.adaptive) throw CLI::ValidationError("--adaptive-grid", "needs --adaptive");
  checkMeshPath(request.output);
  checkJsonPath(request.json);

  MeshRun run;
  detail::Stopwatch total;
  const Mesh mesh = makeMesh(request, run);
  run.vertices = mesh.positions.size();
  run.quads = mesh.quads.size();
  run.triangles = mesh.triangles.size();
  run.origin = mesh.origin;

  detail::Stopwatch stopwatch;
  run.bytesWritten = writeMeshFile(mesh, request.output,
                                   {.ascii = request.ascii, .doublePrecision = request.doublePrecision}, request.quiet);
  run.secondsWrite = stopwatch.lap();
  run.secondsTotal = total.lap();

  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
