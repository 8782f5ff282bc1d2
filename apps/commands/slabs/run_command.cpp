#include <fmt/format.h>

#include <charconv>
#include <cstdio>

#include "commands/slabs/slab_commands.h"
#include "files/json_file.h"
#include "files/mesh_attributes.h"
#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/tile/slab_folder.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"
#include "tiles/planned_request.h"

namespace pdc {
namespace {

struct SlabRange {
  std::optional<std::size_t> first, last;
};

/// \throws CLI::ValidationError
SlabRange parseRange(const std::string& text) {
  if (text.empty()) return {};
  const char *at = text.data(), *const end = at + text.size();
  std::size_t first = 0, last = 0;
  const auto [next, error] = std::from_chars(at, end, first);
  last = first;
  bool good = error == std::errc();
  if (good && next != end) {
    const auto [behind, second] = std::from_chars(next + 1, end, last);
    good = *next == '-' && second == std::errc() && behind == end && last >= first;
  }
  if (!good) throw CLI::ValidationError("--slab", fmt::format("'{}' is not A or A-B, numbers from 0", text));
  return {first, last};
}

}  // namespace

void runRun(const SlabsRequest& request) {
  const SlabRange range = parseRange(request.slab);
  checkJsonPath(request.json);
  detail::Stopwatch stopwatch;
  const SlabFolder folder(request.folder);
  PlannedRequest planned = plannedRequest(folder.request());
  MeshRequest& mesh = planned.mesh;
  mesh.threads = request.threads;
  ProgressBar bar(!request.quiet);
  const Monitor monitor{.progress = [&bar](const char* stage, double share) { bar.update(stage, share); },
                        .stop = &interruptFlag()};
  const Input input = detail::withThreads(mesh.threads.value_or(0),
                                          [&] { return openInput(mesh.input, mesh.inputOptions(), monitor); });
  const auto finish = [&](Mesh& slab) { addAttributes(input, slab, {.progress = {}, .stop = &interruptFlag()}); };
  const SlabRunReport report = runSlabs(folder, *input.source,
                                        {.contour = mesh.contourOptions(input.sigmaNormal),
                                         .first = range.first,
                                         .last = range.last,
                                         .onlyOne = request.next,
                                         .finish = finish},
                                        monitor);
  const double seconds = stopwatch.lap();
  writeJson({{"folder", request.folder.string()},
             {"contoured", report.contoured},
             {"widened", report.widened},
             {"left_to_others", report.left},
             {"seconds", seconds}},
            request.json);
  if (request.quiet || request.json == "-") return;
  fmt::print("{}: {} slabs contoured{}{}; {:.2f} s\n", request.folder.string(), report.contoured,
             report.widened > 0 ? fmt::format(", {} of them again with more layers about them", report.widened) : "",
             report.left > 0 ? fmt::format("; {} are being contoured by others", report.left) : "", seconds);
}

}  // namespace pdc
