#include "requests/grid_steps_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "pdc/error.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "terminal/choice_option.h"
#include "terminal/numbers.h"

namespace pdc {
namespace {

const Choices<SmoothFilter> kFilters{{"mean", SmoothFilter::kMean},
                                     {"gaussian", SmoothFilter::kGaussian},
                                     {"median", SmoothFilter::kMedian},
                                     {"curvature", SmoothFilter::kCurvature}};

[[noreturn]] void refuse(const std::string& option, const std::string& text, const char* limit) {
  throw CLI::ValidationError(option, fmt::format("'{}' is not {}", text, limit));
}

/// The numbers of a list, if they are so many and finite; else nothing.
std::vector<double> finiteReals(const std::string& text, char separator, std::size_t least, std::size_t most) {
  const std::vector<double> v = parseReals(text, separator);
  const bool fits = v.size() >= least && v.size() <= most &&
                    std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  return fits ? v : std::vector<double>();
}

/// An option whose text is stored by take(text, option's name).
template <typename Take>
CLI::Option* addText(CLI::App& command, const std::string& name, const Take& take, const std::string& help) {
  return command.add_option_function<std::string>(
      name, [name, take](const std::string& text) { take(text, name); }, help);
}

void readMeshToLevelSet(const std::string& text, const std::string& option, GridStepsRequest& request) {
  const std::vector<double> v = finiteReals(text, ':', 1, 2);
  if (v.empty() || !(v[0] > 0) || (v.size() == 2 && !(v[1] >= v[0])))
    refuse(option, text, "H or H:W, numbers above 0, W at least H");
  request.meshToLevelSet = MeshToLevelSetOptions{.voxelSize = v[0], .halfWidth = v.size() == 2 ? v[1] : 0};
}

void readClip(const std::string& text, const std::string& option, GridStepsRequest& request) {
  const std::vector<double> v = parseReals(text, ',');
  if (v.empty()) {
    request.clipGrid = text;
    return;
  }
  if (finiteReals(text, ',', 6, 6).empty() || !(v[0] < v[3]) || !(v[1] < v[4]) || !(v[2] < v[5]))
    refuse(option, text, "X0,Y0,Z0,X1,Y1,Z1, finite numbers, the first three below the others, or the name of a grid");
  request.steps.clip = ClipOptions{.box = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
}

void readSmooth(const std::string& text, const std::string& option, GridStepsRequest& request) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto filter =
      std::find_if(kFilters.begin(), kFilters.end(), [&](const auto& f) { return f.first == text.substr(0, colon); });
  const std::vector<double> radius =
      colon < text.size() ? finiteReals(text.substr(colon + 1), ',', 1, 1) : std::vector<double>();
  if (filter == kFilters.end() || radius.empty() || !(radius[0] > 0))
    refuse(option, text, "mean:R, gaussian:R, median:R or curvature:R, R a finite number above 0");
  request.steps.smooth = SmoothGridOptions{.filter = filter->second, .radius = radius[0]};
}

void readKeep(const std::string& text, const std::string& option, GridStepsRequest& request) {
  constexpr std::string_view kAbove = "above:";
  KeepOptions keep;
  const bool above = text.starts_with(kAbove);
  std::size_t& number = above ? keep.moreVoxelsThan : keep.most;
  const char* begin = text.data() + (above ? kAbove.size() : 0);
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(begin, end, number);
  if (text == "largest") {
    keep.most = 1;
  } else if (parsed.ec != std::errc() || parsed.ptr != end || number == 0) {
    refuse(option, text, "largest, a number of parts above 0, or above:VOXELS");
  }
  request.steps.keep = keep;
}

void addCombine(CLI::App& command, const std::string& name, CombineKind kind, GridStepsRequest& request,
                const std::string& help, const std::string& group) {
  command
      .add_option_function<std::vector<std::string>>(
          name,
          [&request, kind](const std::vector<std::string>& files) {
            for (const std::string& file : files) request.combined.emplace_back(kind, file);
          },
          help)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FILE[:GRID]")
      ->group(group);
}

/// A file and a grid's name, from FILE.vdb or FILE.vdb:GRID; no file where neither is there.
std::pair<std::string, std::string> splitName(const std::string& text) {
  constexpr std::string_view kSuffix = ".vdb";
  if (text.ends_with(kSuffix)) return {text, ""};
  const std::size_t at = text.rfind(".vdb:");
  if (at == std::string::npos) return {"", text};
  return {text.substr(0, at + kSuffix.size()), text.substr(at + kSuffix.size() + 1)};
}

}  // namespace

bool GridStepsRequest::isOffsetOnly() const {
  GridStepsRequest others = *this;
  others.steps.offset.reset();
  return others.empty();
}

void addGridSteps(CLI::App& command, GridStepsRequest& request, const std::string& group) {
  GridSteps& steps = request.steps;
  const auto finite = [](double v) { return std::isfinite(v); };
  const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
  const auto to = [&request](auto read) {
    return [&request, read](const std::string& text, const std::string& option) { read(text, option, request); };
  };
  addReal(command, "--fog-to-level-set", steps.fogToLevelSet, finite, "a finite number",
          "A fog volume becomes the level set of its surface at V")
      ->type_name("V")
      ->group(group);
  addText(command, "--mesh-to-level-set", to(readMeshToLevelSet),
          "INPUT is a mesh, which becomes a level set of voxels of H\nand a band of W to each side (3 H)")
      ->type_name("H[:W]")
      ->group(group);
  addText(
      command, "--clip", to(readClip),
      "Leaves what is in a box, X0,Y0,Z0,X1,Y1,Z1, or in the active\nvoxels of a grid of INPUT, or of FILE.vdb[:GRID]")
      ->type_name("BOX|GRID")
      ->group(group);
  std::optional<double>& voxel = request.voxelSize;
  addReal(command, "--resample", voxel, positive, "a finite number above 0", "Other voxels, cubes of edge H")
      ->type_name("H")
      ->group(group);
  addText(command, "--smooth", to(readSmooth), "Filters values: mean, gaussian, median or curvature, over R")
      ->type_name("FILTER:R")
      ->group(group);
  addReal(command, "--offset", steps.offset, finite, "a finite number",
          "The surface goes outwards by D, or inwards below 0; of a mesh,\ntoo")
      ->type_name("D")
      ->group(group);
  addReal(command, "--open-close", steps.openClose, positive, "a finite number above 0",
          "What is thinner than 2 D goes: solid first, then gaps")
      ->type_name("D")
      ->group(group);
  addCombine(command, "--union", CombineKind::kUnion, request, "Adds the solid of another level set", group);
  addCombine(command, "--intersect", CombineKind::kIntersect, request, "Leaves what is in another one, too", group);
  addCombine(command, "--subtract", CombineKind::kSubtract, request, "Takes another one away", group);
  addText(command, "--keep", to(readKeep), "Leaves the largest part, the N largest, or those of more voxels")
      ->type_name("largest|N|above:N")
      ->group(group);
  command.add_flag("--fill-cavities", steps.fillCavities, "Fills what is enclosed by the solid")->group(group);
}

GridSteps loadGridSteps(const GridStepsRequest& request, const std::filesystem::path& input, bool acceptNonFinite,
                        bool open) {
  GridSteps steps = request.steps;
  if (request.voxelSize) steps.resample = ResampleOptions{.voxelSize = *request.voxelSize};
  if (!request.clipGrid.empty()) {
    const auto [file, grid] = splitName(request.clipGrid);
    steps.clip = ClipOptions{.mask = readVdbGrid(file.empty() ? input : std::filesystem::path(file), grid)};
  }
  if (steps.clip) steps.clip->closed = !open;
  for (const auto& [kind, text] : request.combined) {
    const auto [file, grid] = splitName(text);
    if (file.empty())
      throw Error(fmt::format("'{}': the grid to combine with must be FILE.vdb or FILE.vdb:GRID", text));
    steps.combine.push_back({.kind = kind,
                             .other = settleGrid(readVdbGrid(file, grid), {.acceptNonFinite = acceptNonFinite}),
                             .name = text});
  }
  return steps;
}

}  // namespace pdc
