#include "commands/pictures/render_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "commands/pictures/shading_values.h"
#include "files/mesh_file.h"
#include "parallel/with_threads.h"
#include "pdc/io/png_writer.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/numbers.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"
#include "terminal/view_option.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& text, const std::string& wanted) {
  throw CLI::ValidationError(option, fmt::format("'{}' is not {}", text, wanted));
}

void parseSize(const std::string& text, RenderRequest& request) {
  const std::vector<double> size = parseReals(text, 'x');
  const auto sound = [](double side) { return side >= 1 && side <= kMaxImageSide && side == std::floor(side); };
  if (size.size() != 2 || !sound(size[0]) || !sound(size[1]))
    refuse("--size", text, fmt::format("WxH, whole numbers from 1 to {}", kMaxImageSide));
  request.width = static_cast<int>(size[0]);
  request.height = static_cast<int>(size[1]);
}

/// \returns what is wrong with --shading; empty if nothing is.
std::string checkShading(const std::string& shading) {
  if (shading == "clay" || shading == "normal" || isValueShading(shading)) return "";
  return fmt::format("'{}' is not clay, normal, confidence, error or property:NAME", shading);
}

std::size_t countNonFinite(const Mesh& mesh) {
  return static_cast<std::size_t>(std::count_if(mesh.positions.begin(), mesh.positions.end(),
                                                [](const Vec3f& p) { return !std::isfinite(p.x + p.y + p.z); }));
}

Image draw(const RenderRequest& request, std::string& scale) {
  const Mesh mesh = [&] {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "reading " + request.mesh.filename().string());
    return readMeshFile(request.mesh).mesh;
  }();
  if (mesh.empty())
    throw Error(fmt::format("{}: the mesh has no faces, so there is nothing to draw", shownPath(request.mesh)));
  ProgressBar bar(!request.quiet);
  const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
  const Monitor monitor{.progress = show, .stop = &interruptFlag()};
  RenderOptions options{.width = request.width,
                        .height = request.height,
                        .towardsViewer = request.towardsViewer,
                        .shading = request.shading == "normal" ? Shading::kNormal : Shading::kClay,
                        .edges = request.edges};
  ShadingValues shown;
  if (isValueShading(request.shading)) {
    shown = shadingValues(request, mesh, monitor);
    options.shading = Shading::kValues;
    options.values = shown.values;
    options.valueLo = shown.lo;
    options.valueHi = request.range ? static_cast<float>(*request.range) : shown.hi;
    scale = fmt::format("; {} from {:.6g}, blue, to {:.6g}, yellow", shown.name, options.valueLo, options.valueHi);
  }
  Image image = render(mesh, options, monitor);
  if (const std::size_t lost = countNonFinite(mesh); lost > 0 && !request.quiet)
    printWarning(
        fmt::format("{} of {} vertices are not finite; their faces are left out", lost, mesh.positions.size()));
  return image;
}

}  // namespace

void addRenderOptions(CLI::App& command, RenderRequest& request) {
  command.add_option("MESH", request.mesh, ".ply, .obj, .off or .stl")->required()->type_name("");
  command.add_option("OUT", request.picture, ".png")->required()->type_name("");
  addView(command, request.towardsViewer);
  command
      .add_option_function<std::string>(
          "--size", [&request](const std::string& text) { parseSize(text, request); }, "Pixels (1024x1024)")
      ->type_name("WxH");
  command
      .add_option("--shading", request.shading,
                  "Colours (clay): of a matt solid, of the normal's direction,\n"
                  "of the vertices' property \"confidence\", of \"error\", or,\n"
                  "as property:NAME, of any other property")
      ->type_name("WHAT")
      ->check(checkShading);
  command.add_option("--reference", request.reference, "For --shading error: the error is the distance to this mesh")
      ->type_name("MESH");
  addReal(
      command, "--range", request.range, [](double v) { return v > 0 && std::isfinite(v); }, "a finite number > 0",
      "The value that is yellow (confidence: 1, others: the largest)")
      ->type_name("V");
  command.add_flag("--edges", request.edges, "The mesh's edges over it");
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar");
  addThreads(command, request.threads);
  command.footer("Example: pdc render part.ply part.png --view front --size 800x600 --edges");
}

void runRender(const RenderRequest& request) {
  if (!request.reference.empty() && request.shading != "error")
    throw CLI::ValidationError("--reference", "goes with --shading error only");
  checkPngPath(request.picture);
  std::string scale;
  const Image image = detail::withThreads(request.threads.value_or(0), [&] { return draw(request, scale); });
  std::size_t bytes = 0;
  {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "writing " + request.picture.filename().string());
    bytes = writePng(image, request.picture);
  }
  if (!request.quiet)
    fmt::print("{}: {} x {} pixels, {} bytes{}\n", shownPath(request.picture), image.width, image.height, bytes, scale);
}

}  // namespace pdc
