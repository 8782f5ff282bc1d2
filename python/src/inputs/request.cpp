#include "inputs/request.h"

#include <array>
#include <string>

#include "convert.h"

namespace pdc::python {
namespace {

template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

const Words<Placement> kPlacements{
    {"certified", Placement::kCertified}, {"cell", Placement::kCell}, {"free", Placement::kFree}};
const Words<HermiteMode> kHermiteModes{
    {"auto", HermiteMode::kAuto}, {"gradient", HermiteMode::kGradient}, {"distance", HermiteMode::kDistance}};
const Words<GridClass> kGridClasses{{"level-set", GridClass::kLevelSet}, {"fog", GridClass::kFogVolume}};
const Words<InsideValues> kInsides{{"low", InsideValues::kLow}, {"high", InsideValues::kHigh}};
const Words<bool> kNonFiniteModes{{"error", false}, {"outside", true}};

/// Reads options one after the other.
class Options {
 public:
  explicit Options(const py::dict& options) : mOptions(options) {}

  template <typename Target>
  void take(const char* name, Target& target) const {
    using Value = decltype(valueType(target));
    if (const py::object value = given(name); !value.is_none()) target = value.cast<Value>();
  }
  template <typename Value, typename Target>
  void takeWord(const char* name, const Words<Value>& words, Target& target) const {
    if (const py::object value = given(name); !value.is_none())
      target = valueOf(words, name, value.cast<std::string>());
  }
  [[nodiscard]] py::object given(const char* name) const {
    return mOptions.contains(name) ? py::object(mOptions[name]) : py::none();
  }

 private:
  template <typename Value>
  static Value valueType(const std::optional<Value>&);
  template <typename Value>
  static Value valueType(const Value&);

  const py::dict& mOptions;
};

void takeSigma(const Options& options, MeshRequest& request) {
  const py::object sigma = options.given("sigma_normal");
  if (sigma.is_none()) return;
  request.sigmaFromData = py::isinstance<py::str>(sigma);
  if (!request.sigmaFromData) request.sigmaNormal = sigma.cast<double>();
}

void takeMeshOrigin(const Options& options, MeshRequest& request) {
  const py::object origin = options.given("mesh_origin");
  if (origin.is_none()) return;
  request.originFromData = py::isinstance<py::str>(origin);
  if (request.originFromData) return;
  const auto xyz = origin.cast<py::sequence>();
  request.origin = Vec3d{xyz[0].cast<double>(), xyz[1].cast<double>(), xyz[2].cast<double>()};
}

}  // namespace

MeshRequest requestOf(const py::dict& given) {
  const Options options(given);
  MeshRequest request;
  options.take("level", request.iso);
  options.takeWord("inside", kInsides, request.inside);
  options.takeWord("grid_class", kGridClasses, request.gridClass);
  takeSigma(options, request);
  options.takeWord("placement", kPlacements, request.placement);
  options.takeWord("hermite", kHermiteModes, request.hermite);
  options.take("open", request.open);
  options.take("flood_fill", request.floodFill);
  options.takeWord("nan", kNonFiniteModes, request.acceptNonFinite);
  options.take("triangles", request.triangles);
  options.take("normals", request.normals);
  options.take("confidence", request.confidence);
  options.take("rank", request.rank);
  if (const py::object adaptive = options.given("adaptive"); !adaptive.is_none())
    request.adaptive = {adaptive.cast<py::tuple>()[0].cast<double>(), adaptive.cast<py::tuple>()[1].cast<bool>()};
  options.take("voxel_size", request.voxelSize);
  options.take("resolution", request.resolution);
  options.take("grid", request.grid);
  options.take("sigma_grid", request.sigmaGrid);
  options.take("weight_grid", request.weightGrid);
  takeMeshOrigin(options, request);
  options.take("max_memory", request.maxMemory);
  options.take("threads", request.threads);
  return request;
}

}  // namespace pdc::python
