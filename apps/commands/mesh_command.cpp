#include "commands/mesh_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "extract/contour_memory.h"
#include "files/json_file.h"
#include "files/mesh_attributes.h"
#include "files/mesh_file.h"
#include "io/mesh/mesh_format.h"
#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/extract/contour_forecast.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "reports/json_report.h"
#include "reports/mesh_checks.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"
#include "tiles/contour_in_slabs.h"

namespace pdc {
namespace {

void warn(MeshRun& run, const std::string& message) {
  run.warnings.push_back(message);
  printWarning(run.frame + message);
}

void checkSurface(const MeshRequest& request, const Input& input, const Mesh& mesh, MeshRun& run) {
  if (!mesh.empty()) return;
  const std::string message = input.whyEmpty() + "; the mesh is empty";
  if (request.requireSurface) throw Error(message);
  warn(run, message);
}

/// Bytes of a mesh's file, roughly.
double fileSize(const MeshRequest& request, const ContourForecast& forecast) {
  const bool text = request.ascii || detail::outputFormat(request.output).isText();
  constexpr double kBinary = 29, kText = 60;  // for a vertex and a quad, as closed meshes have
  return (text ? kText : kBinary) * forecast.vertices;
}

/// Refuses what will not fit into memory before the work begins, and tells of what takes long.
void checkForecast(const MeshRequest& request, const std::optional<ContourForecast>& forecast, const MeshRun& run) {
  if (!forecast) return;
  detail::checkMemory(forecast->memory, forecast->vertices, run.options);
  constexpr double kMuch = 1e9;
  if (forecast->memory < kMuch || request.quiet) return;
  std::fputs(fmt::format("pdc: about {} vertices, {} of memory, a file of {}\n", detail::countText(forecast->vertices),
                         detail::bytesText(forecast->memory), detail::bytesText(fileSize(request, *forecast)))
                 .c_str(),
             stderr);
}

/// An input, and how long it took to read.
struct ReadInput {
  Input input;
  double seconds;
};

ReadInput readInput(const MeshRequest& request, const Monitor& monitor) {
  detail::Stopwatch stopwatch;
  Input input = openInput(request.input, request.inputOptions(), monitor);
  return {std::move(input), stopwatch.lap()};
}

ReadInput readAndShow(const MeshRequest& request) {
  const ExitOnInterrupt scope;
  if (!request.readsInSteps()) {
    const BusySign sign(!request.quiet, "reading " + request.input.filename().string());
    return readInput(request, {});
  }
  ProgressBar bar(!request.quiet);
  const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
  return detail::withThreads(request.threads.value_or(0),
                             [&] { return readInput(request, {.progress = show, .stop = &interruptFlag()}); });
}

/// Notes what was read, and how it is contoured.
void beginRun(const MeshRequest& request, const ReadInput& read, MeshRun& run) {
  const Input& input = read.input;
  run.secondsRead = read.seconds;
  if (input.refusedNoise > 0)
    warn(run,
         fmt::format("{} values of the noise grids are negative or not finite; they count as 0", input.refusedNoise));
  for (const std::string& warning : input.warnings) warn(run, warning);
  checkAttributes(input, request.ownProperties());
  run.meaning = input.meaning;
  run.mesh = input.mesh;
  run.steps = input.steps;
  run.volume = input.volume;
  run.crossingsWithoutData = input.crossingsWithoutData;
  run.iso = input.iso;
  run.planeOrigin = input.planeOrigin;
  run.valueNoise = input.valueNoise;
  run.options = request.contourOptions(input.sigmaNormal);
  if (request.adaptive)
    run.options.adaptive = request.adaptive->value * (request.adaptive->suffixed ? input.source->map().voxelSize() : 1);
  run.options.adaptiveScale = input.adaptiveScale;
}

Mesh makeMesh(const MeshRequest& request, const Input& input, const std::optional<ContourForecast>& forecast,
              MeshRun& run) {
  detail::Stopwatch stopwatch;
  checkForecast(request, forecast, run);
  Mesh mesh;
  {
    ProgressBar bar(!request.quiet);
    const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
    mesh = contour(*input.source, run.options, &run.contour, {.progress = show, .stop = &interruptFlag()});
  }
  addAttributes(input, mesh, {.progress = {}, .stop = &interruptFlag()});
  run.secondsContour = stopwatch.lap();
  checkSurface(request, input, mesh, run);
  for (const std::string& warning : meshWarnings(input, mesh, {})) warn(run, warning);
  run.verticesOnBox = verticesOnBox(input, mesh);
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

std::string knownText(const std::string& text) { return text.empty() ? "not known" : text; }

void printSummary(const MeshRequest& request, const MeshRun& run) {
  const std::size_t open = run.contour.boundaryEdges;
  const auto boundary = open == 0 ? std::string("closed") : fmt::format("{} boundary edges", open);
  fmt::print("{}: {} vertices, {}, {}; {} bytes\n", shownPath(request.output), run.vertices, facesText(run), boundary,
             run.bytesWritten);
  if (run.meaning)
    fmt::print("a {} ({}), {} values inside ({})\n", nameOf(run.meaning->gridClass), phraseOf(run.meaning->classBy),
               nameOf(run.meaning->inside), phraseOf(run.meaning->insideBy));
  if (run.volume)
    fmt::print("{}, {} x {} x {} values, iso {:.6g}; frame {}, unit {}\n", run.volume->format, run.volume->size[0],
               run.volume->size[1], run.volume->size[2], run.iso, knownText(run.volume->space),
               knownText(run.volume->unit));
  if (run.mesh)
    fmt::print("a mesh of {} triangles, {}; voxels of {:.4g}\n", run.mesh->triangles,
               run.mesh->openEdges == 0 ? "closed" : fmt::format("{} open edges", run.mesh->openEdges),
               run.mesh->voxelSize);
  if (run.slabs > 1) fmt::print("contoured in {} slabs\n", run.slabs);
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
  if (!run.options.sigmaNormal && run.slabs == 1)
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

/// How the mesh is written, beside what is known of the input.
MeshWriteOptions writeOptions(const MeshRequest& request, const MeshRun& run) {
  return {.ascii = request.ascii,
          .doublePrecision = request.doublePrecision,
          .space = run.volume ? run.volume->space : "",
          .unit = request.unit.empty() && run.volume ? run.volume->unit : request.unit,
          .source = request.input.filename().string(),
          .settings = request.settings};
}

void writeMesh(const MeshRequest& request, const Mesh& mesh, MeshRun& run) {
  run.vertices = mesh.positions.size();
  run.quads = mesh.quads.size();
  run.triangles = mesh.triangles.size();
  run.origin = mesh.origin;
  run.properties = propertiesJson(mesh.properties);
  const std::string lost = lostProperties(mesh, request.output);
  if (!lost.empty())
    warn(run,
         fmt::format("{}: only {} files hold {}", shownPath(request.output), detail::kFormatsWithProperties, lost));
  detail::Stopwatch stopwatch;
  run.bytesWritten = writeMeshFile(mesh, request.output, writeOptions(request, run), request.quiet);
  run.secondsWrite = stopwatch.lap();
}

/// Contours and writes what is too large to be contoured as one.
void makeInSlabs(const MeshRequest& request, const Input& input, MeshRun& run) {
  detail::Stopwatch stopwatch;
  ProgressBar bar(!request.quiet);
  const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
  const SlabbedMesh made = contourInSlabs(input, run.options, request.output, writeOptions(request, run),
                                          {.progress = show, .stop = &interruptFlag()});
  run.slabs = made.slabs;
  run.vertices = made.merged.vertices;
  run.quads = made.merged.quads;
  run.triangles = made.merged.triangles;
  run.bytesWritten = made.merged.bytesWritten;
  run.properties = propertiesJson(made.merged.properties);
  run.origin = made.origin;
  run.contour.blocks = made.merged.blocks;
  run.contour.boundaryEdges = made.merged.boundaryEdges;
  run.contour.multiVertexCells = made.merged.multiVertexCells;
  run.contour.uncertified = made.merged.uncertified;
  run.secondsContour = stopwatch.lap();
}

/// Contours what was read and writes the mesh.
void contourAndWrite(const MeshRequest& request, const ReadInput& read, MeshRun& run) {
  detail::Stopwatch total;
  beginRun(request, read, run);
  const auto forecast = forecastContour(*read.input.source, run.options, {.stop = &interruptFlag()});
  bool inSlabs = false;
  try {
    writeMesh(request, makeMesh(request, read.input, forecast, run), run);
  } catch (const detail::TooLarge&) {
    if (!canBeInSlabs(request.output, run.options, forecast)) throw;
    inSlabs = true;
  }
  if (inSlabs) makeInSlabs(request, read.input, run);
  run.secondsTotal = run.secondsRead + total.lap();
}

void checkRequest(const MeshRequest& request) {
  checkMeshRequest(request);
  if (request.adaptiveGrid && !request.adaptive) throw CLI::ValidationError("--adaptive-grid", "needs --adaptive");
  checkMeshPath(request.output);
  checkJsonPath(request.json);
}

/// The reports of a sequence's frames, a line for each, in their order.
class FrameReports {
 public:
  explicit FrameReports(const std::filesystem::path& path) : mLines(path) {}

  void add(const nlohmann::ordered_json& report, int frame) {
    nlohmann::ordered_json line{{"frame", frame}};
    line.update(report);
    mLines.add(line);
  }

 private:
  JsonLines mLines;
};

/// What a sequence did, by numbers of frames.
struct FrameCounts {
  std::size_t there = 0, failed = 0;
};

struct Frame {
  int number;
  bool isThere;
};

/// What is to be done for each frame of a sequence.
class FrameRequests {
 public:
  explicit FrameRequests(const MeshRequest& all)
      : mAll(all), mInputs(all.input.string(), "INPUT"), mOutputs(all.output.string(), "OUTPUT") {}

  [[nodiscard]] MeshRequest of(int number) const {
    MeshRequest request = mAll;
    request.input = mInputs.of(number);
    request.output = mOutputs.of(number);
    return request;
  }

 private:
  const MeshRequest& mAll;
  FrameNames mInputs, mOutputs;
};

/// Contours a frame that was read. \returns whether that worked.
bool runFrame(const MeshRequest& request, int number, std::future<ReadInput>& reading, FrameReports& reports) {
  MeshRun run;
  run.frame = fmt::format("frame {}: ", number);
  try {
    const ReadInput read = reading.get();
    contourAndWrite(request, read, run);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    std::fputs(fmt::format("pdc: {}{}\n", run.frame, error.what()).c_str(), stderr);
    reports.add({{"input", shownPath(request.input)}, {"error", error.what()}}, number);
    return false;
  }
  reports.add(toJson(request, run), number);
  if (!request.quiet && request.json != "-")
    fmt::print("{}{}: {} vertices, {}; {:.2f} s\n", run.frame, shownPath(request.output), run.vertices, facesText(run),
               run.secondsTotal);
  return true;
}

/// Contours the frames that are there, each while the next is read.
FrameCounts runInOrder(const FrameRequests& requests, const std::vector<Frame>& frames, FrameReports& reports) {
  auto toRead = frames.begin();
  const auto beginNext = [&]() -> std::future<ReadInput> {
    toRead = std::find_if(toRead, frames.end(), [](const Frame& f) { return f.isThere; });
    if (toRead == frames.end()) return {};
    return std::async(std::launch::async, [request = requests.of((toRead++)->number)] {
      return readInput(request, {.progress = {}, .stop = &interruptFlag()});
    });
  };
  FrameCounts counts;
  std::future<ReadInput> next = beginNext();
  for (const auto& [number, isThere] : frames) {
    const MeshRequest request = requests.of(number);
    if (!isThere) {
      reports.add({{"input", shownPath(request.input)}, {"missing", true}}, number);
      continue;
    }
    std::future<ReadInput> now = std::move(next);
    now.wait();
    next = beginNext();
    ++counts.there;
    if (!runFrame(request, number, now, reports)) ++counts.failed;
  }
  return counts;
}

void runFrames(const MeshRequest& request) {
  const FrameRequests requests(request);
  // Files appear when they are complete, and reading cannot be asked to stop.
  const ExitOnInterrupt scope;
  std::vector<Frame> frames;
  for (const int number : request.frames->numbers()) {
    const MeshRequest frame = requests.of(number);
    if (frames.empty()) checkRequest(frame);
    const bool isThere = std::filesystem::exists(frame.input);
    if (!isThere) printWarning(fmt::format("frame {}: '{}' is not there", number, frame.input.string()));
    frames.push_back({number, isThere});
  }
  if (std::none_of(frames.begin(), frames.end(), [](const Frame& f) { return f.isThere; }))
    throw Error(fmt::format("'{}': no frame is there", shownPath(request.input)));
  FrameReports reports(request.json);
  const FrameCounts counts = runInOrder(requests, frames, reports);
  if (counts.failed > 0) throw Error(fmt::format("{} of {} frames failed", counts.failed, counts.there));
}

}  // namespace

void runMesh(const MeshRequest& request) {
  if (request.frames) {
    runFrames(request);
    return;
  }
  checkRequest(request);
  MeshRun run;
  contourAndWrite(request, readAndShow(request), run);
  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
