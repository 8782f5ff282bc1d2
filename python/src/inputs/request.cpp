#include "inputs/request.h"

#include <array>
#include <string>

#include "given_options.h"
#include "pdc/error.h"

namespace pdc::python {
namespace {

const Words<Placement> kPlacements{
    {"certified", Placement::kCertified}, {"cell", Placement::kCell}, {"free", Placement::kFree}};
const Words<HermiteMode> kHermiteModes{
    {"auto", HermiteMode::kAuto}, {"gradient", HermiteMode::kGradient}, {"distance", HermiteMode::kDistance}};
const Words<GridClass> kGridClasses{{"level-set", GridClass::kLevelSet}, {"fog", GridClass::kFogVolume}};
const Words<InsideValues> kInsides{{"low", InsideValues::kLow}, {"high", InsideValues::kHigh}};
const Words<bool> kNonFiniteModes{{"error", false}, {"outside", true}};
const Words<WorldFrame> kFrames{{"file", WorldFrame::kFile}, {"ras", WorldFrame::kRas}, {"lps", WorldFrame::kLps}};

void takeSigma(const GivenOptions& options, MeshRequest& request) {
  const py::object sigma = options.given("sigma_normal");
  if (sigma.is_none()) return;
  request.sigmaFromData = py::isinstance<py::str>(sigma);
  if (!request.sigmaFromData) request.sigmaNormal = sigma.cast<double>();
}

void takeMeshOrigin(const GivenOptions& options, MeshRequest& request) {
  const py::object origin = options.given("mesh_origin");
  if (origin.is_none()) return;
  request.originFromData = py::isinstance<py::str>(origin);
  if (request.originFromData) return;
  const auto xyz = origin.cast<py::sequence>();
  request.origin = Vec3d{xyz[0].cast<double>(), xyz[1].cast<double>(), xyz[2].cast<double>()};
}

/// What is to be done with further grids of a .vdb file, by their names.
void takeGridNames(const GivenOptions& options, MeshRequest& request) {
  options.take("sigma_grid", request.sigmaGrid);
  options.take("weight_grid", request.weightGrid);
  options.take("adaptive_grid", request.adaptiveGrid);
  options.take("attributes", request.attributes);
  options.take("all_attributes", request.allAttributes);
}

}  // namespace

VolumeReadOptions volumeOptionsOf(const GivenOptions& options) {
  VolumeReadOptions volume;
  std::optional<std::string> raw;
  options.take("raw", raw);
  try {
    if (raw) volume.raw = parseRawVolume(*raw);
  } catch (const Error& error) {
    throw py::value_error(std::string("raw: ") + error.what());
  }
  options.take("array", volume.array);
  options.take("series", volume.series);
  options.take("volume_index", volume.volumeIndex);
  options.take("channel", volume.channel);
  options.take("spacing", volume.spacing);
  options.takeWord("space", kFrames, volume.frame);
  return volume;
}

GridMeaningOptions meaningOf(const GivenOptions& options) {
  GridMeaningOptions meaning;
  options.take("level", meaning.iso);
  options.takeWord("grid_class", kGridClasses, meaning.gridClass);
  options.takeWord("inside", kInsides, meaning.inside);
  options.take("flood_fill", meaning.floodFill);
  return meaning;
}

bool acceptsNonFinite(const GivenOptions& options) {
  bool accept = false;
  options.takeWord("nan", kNonFiniteModes, accept);
  return accept;
}

MeshRequest requestOf(const py::dict& given) {
  const GivenOptions options(given);
  MeshRequest request;
  const GridMeaningOptions meaning = meaningOf(options);
  request.iso = meaning.iso;
  request.inside = meaning.inside;
  request.gridClass = meaning.gridClass;
  request.floodFill = meaning.floodFill;
  options.take("otsu", request.isoFromOtsu);
  takeSigma(options, request);
  options.takeWord("placement", kPlacements, request.placement);
  options.takeWord("hermite", kHermiteModes, request.hermite);
  options.take("open", request.open);
  request.acceptNonFinite = acceptsNonFinite(options);
  options.take("triangles", request.triangles);
  options.take("normals", request.normals);
  options.take("confidence", request.confidence);
  options.take("rank", request.rank);
  if (const py::object adaptive = options.given("adaptive"); !adaptive.is_none())
    request.adaptive = {adaptive.cast<py::tuple>()[0].cast<double>(), adaptive.cast<py::tuple>()[1].cast<bool>()};
  options.take("voxel_size", request.voxelSize);
  options.take("resolution", request.resolution);
  options.take("grid", request.grid);
  options.take("offset", request.steps.steps.offset);
  options.take("shell", request.shell);
  takeGridNames(options, request);
  request.volume = volumeOptionsOf(options);
  takeMeshOrigin(options, request);
  options.take("max_memory", request.maxMemory);
  options.take("threads", request.threads);
  return request;
}

}  // namespace pdc::python
