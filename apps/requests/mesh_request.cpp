#include "requests/mesh_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/json_file.h"
#include "files/mesh_file.h"
#include "io/mesh/mesh_format.h"
#include "pdc/error.h"
#include "pdc/sample/implicit/field_source.h"
#include "requests/volume_request.h"
#include "terminal/choice_option.h"
#include "terminal/numbers.h"
#include "terminal/settings.h"

namespace pdc {
namespace {

const Choices<Placement> kPlacements{
    {"certified", Placement::kCertified}, {"cell", Placement::kCell}, {"free", Placement::kFree}};
const Choices<HermiteMode> kHermiteModes{
    {"auto", HermiteMode::kAuto}, {"gradient", HermiteMode::kGradient}, {"distance", HermiteMode::kDistance}};
const Choices<GridClass> kGridClasses{{"level-set", GridClass::kLevelSet}, {"fog", GridClass::kFogVolume}};
const Choices<InsideValues> kInsides{{"low", InsideValues::kLow}, {"high", InsideValues::kHigh}};
const Choices<bool> kNonFiniteModes{{"error", false}, {"outside", true}};

void addSurfaceOptions(CLI::App& command, MeshRequest& request) {
  const auto group = "Surface";
  addIso(command, request,
         "Isovalue (level sets and scenes: 0, fog volumes: 0.5,\ndense ones: otsu, between two classes of values)")
      ->group(group);
  const auto sigma = [&request](const std::string& text) {
    const std::vector<double> value = parseReals(text, ',');
    const bool number = value.size() == 1 && value[0] >= 0;
    if (text != "auto" && !number)
      throw CLI::ValidationError("--sigma-n", fmt::format("'{}' is not a number >= 0 or inf, or auto", text));
    request.sigmaFromData = !number;
    request.sigmaNormal = number ? std::optional(value[0]) : std::nullopt;
  };
  command
      .add_option_function<std::string>("--sigma-n", sigma, "Assumed noise of the unit normals (auto: from the data)")
      ->type_name("S|inf|auto")
      ->group(group);
  addPlacement(command, request.placement,
               "Where vertices may lie (certified): free as far as no faces\n"
               "intersect, in their cell, or free without that promise")
      ->group(group);
  command.add_flag("--open", request.open, "Surface ends where the data ends, instead of being closed")->group(group);
  addNonFinite(command, request.acceptNonFinite)->group(group);
  command.add_flag("--triangles", request.triangles, "Triangles instead of quads")->group(group);
  addVoxelLength(command, "--adaptive", request.adaptive,
                 "Fewer faces where the surface is simple, no point farther than\nthis from the full mesh or back; "
                 "0.1v: in voxels")
      ->type_name("E|Ev")
      ->group(group);
  command.add_flag("--normals", request.normals, "A normal per vertex")->group(group);
  command
      .add_flag("--confidence", request.confidence,
                "A confidence from 0 to 1 per vertex, and the standard\ndeviation along its normal, sigma, in a .ply, "
                ".vtp or .glb")
      ->group(group);
  command.add_flag("--rank", request.rank, "Per vertex 1 (flat), 2 (edge) or 3 (corner)")->group(group);
  command.add_flag("--require-surface", request.requireSurface, "An empty mesh is an error")->group(group);
}

/// Declares --origin and --double.
void addPlaceOptions(CLI::App& command, MeshRequest& request, const std::string& group) {
  const auto origin = [&request](const std::string& text) {
    const std::vector<double> xyz = parseReals(text, ',');
    const bool point =
        xyz.size() == 3 && std::all_of(xyz.begin(), xyz.end(), [](double v) { return std::isfinite(v); });
    if (text != "auto" && !point)
      throw CLI::ValidationError("--origin", fmt::format("'{}' is not X,Y,Z, three finite numbers, or auto", text));
    request.originFromData = !point;
    request.origin = point ? std::optional(Vec3d{xyz[0], xyz[1], xyz[2]}) : std::nullopt;
  };
  command
      .add_option_function<std::string>("--origin", origin,
                                        "Subtracted from the coordinates, and named in the file (0,0,0);\n"
                                        "auto: near the surface if that is too far out for single precision")
      ->type_name("X,Y,Z|auto")
      ->group(group);
  command
      .add_flag("--double", request.doublePrecision,
                "Coordinates in double precision, in a .ply, .obj or .vtp: keeps\nwhat lies far from the origin")
      ->group(group);
}

void addInputOptions(CLI::App& command, MeshRequest& request) {
  const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
  const auto fields = "For .vdb inputs and volumes";
  addChoice(command, "--hermite", request.hermite, kHermiteModes,
            "Where planes come from (auto): gradients at crossings; or,\n"
            "beside creases, distances; auto: distances if the grid has them")
      ->type_name("MODE")
      ->group(fields);
  addGridMeaning(command, request, fields);
  const auto grids = "For .vdb inputs";
  command.add_option("--grid", request.grid, "Grid to take, if the file has several")->type_name("NAME")->group(grids);
  addNoiseGrids(command, request, grids);
  addAdaptiveGrid(command, request, grids);
  addAttribute(command, request, grids);
  addVolumeOptions(command, request.volume, "For volumes");
  const auto scenes = "For scenes and meshes";
  addReal(command, "--voxel-size", request.voxelSize, positive, "a finite number > 0", "Edge of a cell, in world units")
      ->type_name("H")
      ->group(scenes);
  addInteger(command, "--resolution", request.resolution, 1, kMaxVoxelsPerAxis,
             "Cells along the longest side of the box (meshes: 128)")
      ->type_name("N")
      ->group(scenes);
  addReal(command, "--shell", request.shell, positive, "a finite number > 0",
          "Of a mesh only a wall of thickness T, inwards from its\nsurface; after --offset")
      ->type_name("T")
      ->group(scenes);
}

/// The names alone tell these: what the file holds is known once it is read.
void checkNoiseGrid(const MeshRequest& request, const char* option, const std::optional<std::string>& name) {
  if (!name) return;
  if (name->empty()) throw Error(fmt::format("{}: the name is empty", option));
  if (name == request.grid) throw Error(fmt::format("{}: '{}' is the grid itself", option, *name));
}

void refuseOther(bool given, const char* name, const char* takers) {
  if (given) throw CLI::ValidationError(name, fmt::format("goes with {} only", takers));
}

/// What neither volumes nor scenes nor meshes have.
void refuseGridOptions(const MeshRequest& request) {
  const auto grids = ".vdb inputs";
  refuseOther(request.grid.has_value(), "--grid", grids);
  refuseOther(request.floodFill, "--flood-fill", grids);
  refuseOther(request.sigmaGrid.has_value(), "--sigma-grid", grids);
  refuseOther(request.weightGrid.has_value(), "--weight-grid", grids);
  refuseOther(request.adaptiveGrid.has_value(), "--adaptive-grid", grids);
  refuseOther(request.allAttributes || !request.attributes.empty(), "--attribute", grids);
}

/// What neither scenes nor meshes have.
void refuseValueOptions(const MeshRequest& request) {
  const auto values = "grids and volumes";
  refuseGridOptions(request);
  refuseOther(request.hermite.has_value(), "--hermite", values);
  refuseOther(request.gridClass.has_value(), "--class", values);
  refuseOther(request.inside.has_value(), "--inside", values);
}

void checkOutputHolds(const MeshRequest& request) {
  const detail::OutputFormat format = detail::outputFormat(request.output);
  const std::string withProperties = fmt::format("{} outputs", detail::kFormatsWithProperties);
  refuseOther(request.confidence && !format.holdsProperties(), "--confidence", withProperties.c_str());
  refuseOther(request.rank && !format.holdsProperties(), "--rank", withProperties.c_str());
  refuseOther(request.doublePrecision && !format.holdsDoubles(), "--double",
              fmt::format("{} outputs", detail::kFormatsWithDoubles).c_str());
}

}  // namespace

InputOptions MeshRequest::inputOptions() const {
  GridStepsRequest ofGrid = steps;
  if (ofMesh()) ofGrid.steps.offset.reset();
  return {.iso = iso,
          .open = open,
          .acceptNonFinite = acceptNonFinite.value_or(false),
          .hermite = hermite.value_or(HermiteMode::kAuto),
          .gridClass = gridClass,
          .inside = inside,
          .grid = grid,
          .floodFill = floodFill,
          .sigmaGrid = sigmaGrid,
          .weightGrid = weightGrid,
          .attributes = attributes,
          .allAttributes = allAttributes,
          .adaptiveGrid = adaptiveGrid,
          .steps = loadGridSteps(ofGrid, input, acceptNonFinite.value_or(false), open),
          .meshToLevelSet = steps.meshToLevelSet,
          .volume = volume,
          .isoFromOtsu = isoFromOtsu,
          .voxelSize = voxelSize,
          .resolution = resolution,
          .offset = ofMesh() ? steps.steps.offset : std::nullopt,
          .shell = shell};
}

std::vector<std::string> MeshRequest::ownProperties() const {
  std::vector<std::string> names;
  if (confidence) names.insert(names.end(), {"confidence", "sigma"});
  if (rank) names.push_back("rank");
  return names;
}

ContourOptions MeshRequest::contourOptions(std::optional<double> otherSigma) const {
  return {
      .sigmaNormal = sigmaFromData ? std::nullopt : (sigmaNormal ? sigmaNormal : otherSigma),
      .placement = placement,
      .triangles = triangles,
      .normals = normals,
      .confidence = confidence,
      .ranks = rank,
      .origin = originFromData || (doublePrecision && !origin) ? std::nullopt : std::optional(origin.value_or(Vec3d{})),
      .exactSums = doublePrecision,
      .maxMemory = maxMemory,
      .threads = threads.value_or(0)};
}

std::string placementName(Placement placement) {
  return std::find_if(kPlacements.begin(), kPlacements.end(), [&](const auto& p) { return p.second == placement; })
      ->first;
}

CLI::Option* addIso(CLI::App& command, MeshRequest& request, const std::string& help) {
  const auto take = [&request](const std::string& text) {
    const std::vector<double> value = parseReals(text, ',');
    const bool number = value.size() == 1 && std::isfinite(value[0]);
    if (text != "otsu" && !number)
      throw CLI::ValidationError("--iso", fmt::format("'{}' is not a finite number, or otsu", text));
    request.isoFromOtsu = !number;
    request.iso = number ? std::optional(value[0]) : std::nullopt;
  };
  return command.add_option_function<std::string>("--iso", take, help)->type_name("V|otsu");
}

CLI::Option* addPlacement(CLI::App& command, Placement& target, const std::string& help) {
  return addChoice(command, "--placement", target, kPlacements, help)->type_name("WHERE");
}

CLI::Option* addNonFinite(CLI::App& command, std::optional<bool>& target) {
  return addChoice(command, "--nan", target, kNonFiniteModes,
                   "What NaN, inf and -inf of voxels and functions are (error):\nan error, or outside")
      ->type_name("MODE");
}

void addGridMeaning(CLI::App& command, MeshRequest& request, const std::string& group) {
  addChoice(command, "--class", request.gridClass, kGridClasses,
            "What the values are (the grid's class, or as they look)")
      ->type_name("CLASS")
      ->group(group);
  addChoice(command, "--inside", request.inside, kInsides, "Which values are inside (low in level sets, high in fogs)")
      ->type_name("SIDE")
      ->group(group);
  command
      .add_flag("--flood-fill", request.floodFill,
                "Inactive values become inside or outside, as the active\nones of a level set beside them are")
      ->group(group);
}

void addNoiseGrids(CLI::App& command, MeshRequest& request, const std::string& group) {
  command
      .add_option("--sigma-grid", request.sigmaGrid,
                  "Grid of the same file: standard deviation of each value,\nin its units; adds to --sigma-n")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--weight-grid", request.weightGrid,
                  "Grid of the same file: how much each value counts;\n0 is no data, where --open ends the surface")
      ->type_name("NAME")
      ->group(group);
}

void addAdaptiveGrid(CLI::App& command, MeshRequest& request, const std::string& group) {
  command
      .add_option("--adaptive-grid", request.adaptiveGrid,
                  "Grid of the same file by which the distance of --adaptive is\nmultiplied: 1 keeps it, 0.1 leaves a "
                  "tenth")
      ->type_name("NAME")
      ->group(group);
}

void addAttribute(CLI::App& command, MeshRequest& request, const std::string& group) {
  const auto take = [&request](const std::string& text) {
    request.allAttributes = text == "all";
    request.attributes.clear();
    for (std::size_t begin = 0; !request.allAttributes && begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      if (end == begin) throw CLI::ValidationError("--attribute", fmt::format("'{}' has an empty name", text));
      request.attributes.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  };
  command
      .add_option_function<std::string>(
          "--attribute", take,
          "Grids of the same file whose values the vertices get, in a .ply, .vtp or .glb\n"
          "(of Cd, colours, in an .obj, too); all: all others")
      ->type_name("NAME,...|all")
      ->group(group);
}

namespace {

void addInput(CLI::App& command, MeshRequest& request) {
  const auto kinds =
      ".vdb, a volume (.nii.gz, .nrrd, .mha,\n.npy, ...), a scene (.yaml, .yml), or a mesh:\n.ply, .obj, .off, .stl";
  command.add_option("INPUT", request.input, kinds)->required()->type_name("");
}

/// Declares what says how a mesh is made and written, and what is said meanwhile.
void addSettings(CLI::App& command, MeshRequest& request) {
  addSurfaceOptions(command, request);
  addInputOptions(command, request);
  addGridSteps(command, request.steps, "For .vdb inputs and volumes, before all else, in this order");
  const auto group = "Output";
  command.add_flag("--ascii", request.ascii, ".ply and .stl as text")->group(group);
  command
      .add_option("--unit", request.unit,
                  "What coordinates are in, in headers that hold it (the input's;\nmm in a .3mf)")
      ->check(CLI::IsMember({"um", "mm", "cm", "m", "in", "ft"}))
      ->type_name("UNIT")
      ->group(group);
  command.parse_complete_callback([&command, &request] { request.settings = settingsText(command); });
  addPlaceOptions(command, request, group);
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(group);
  command
      .add_option("--max-memory", request.maxMemory, "Most memory to use, as 8GB or 500MB\n(0: what the machine has)")
      ->type_name("SIZE")
      ->transform(CLI::AsSizeValue(true))
      ->transform(CLI::Validator(
          [](const std::string& text) {
            return text.starts_with('-') ? fmt::format("'{}' is less than 0", text) : std::string();
          },
          ""))
      ->group(group);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(group);
  addThreads(command, request.threads)->group(group);
}

}  // namespace

void addMeshOptions(CLI::App& command, MeshRequest& request) {
  addInput(command, request);
  command.add_option("OUTPUT", request.output, kWrittenMeshes)->required()->type_name("");
  command
      .add_option_function<std::string>(
          "--frames", [&request](const std::string& text) { request.frames = parseFrames(text); },
          "All of a sequence: INPUT and OUTPUT are patterns like\nsmoke.%04d.vdb; a report is a line per frame")
      ->type_name("A-B[:STEP]");
  addSettings(command, request);
}

void addPlanOptions(CLI::App& command, MeshRequest& request, std::filesystem::path& folder) {
  addInput(command, request);
  command.add_option("FOLDER", folder, "Where slabs are contoured; it is made")->required()->type_name("");
  addSettings(command, request);
}

void checkMeshRequest(const MeshRequest& request) {
  refuseOther(request.shell && !request.ofMesh(), "--shell", "meshes");
  if (request.kind() != InputKind::kVolume) {
    refuseVolumeOptions(request.volume);
    refuseOther(request.isoFromOtsu, "--iso otsu", "volumes");
  }
  switch (request.kind()) {
    case InputKind::kVolume:
      refuseOther(request.voxelSize.has_value(), "--voxel-size", "scenes and meshes");
      refuseOther(request.resolution.has_value(), "--resolution", "scenes and meshes");
      refuseOther(request.steps.meshToLevelSet.has_value(), "--mesh-to-level-set", "meshes");
      refuseGridOptions(request);
      break;
    case InputKind::kGrid:
      refuseOther(request.voxelSize.has_value(), "--voxel-size", "scenes and meshes");
      refuseOther(request.resolution.has_value(), "--resolution", "scenes and meshes");
      checkNoiseGrid(request, "--sigma-grid", request.sigmaGrid);
      checkNoiseGrid(request, "--weight-grid", request.weightGrid);
      checkNoiseGrid(request, "--adaptive-grid", request.adaptiveGrid);
      refuseOther(request.steps.meshToLevelSet.has_value(), "--mesh-to-level-set", "meshes");
      refuseOther(!request.steps.empty() && request.sigmaGrid, "--sigma-grid", "grids without steps");
      refuseOther(!request.steps.empty() && request.weightGrid, "--weight-grid", "grids without steps");
      break;
    case InputKind::kScene:
      refuseValueOptions(request);
      refuseOther(!request.steps.empty(), "a step on grids", "grids and volumes");
      break;
    case InputKind::kMesh:
      if (request.steps.meshToLevelSet) break;
      refuseValueOptions(request);
      refuseOther(request.iso.has_value(), "--iso", "grids, volumes and scenes");
      refuseOther(request.open, "--open", "grids, volumes and scenes");
      refuseOther(!request.steps.isOffsetOnly(), "a step on grids but --offset", "grids and volumes");
      break;
    case InputKind::kOther:
      if (request.steps.meshToLevelSet) break;
      throw Error(fmt::format(
          "'{}': not a kind of input; the suffix must be .vdb, .yaml, .yml, .ply, .obj, .off, .stl or a volume's",
          request.input.string()));
  }
  // Sweeps have no output of this kind, and none of these options.
  if (request.confidence || request.rank || request.doublePrecision) checkOutputHolds(request);
  if (request.voxelSize && request.resolution) throw CLI::ValidationError("--voxel-size", "excludes --resolution");
  checkJsonReplaces(request.json, request.input, request.output);
}

}  // namespace pdc
