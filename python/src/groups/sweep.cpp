#include "pdc/study/sweep.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <utility>
#include <vector>

#include "convert.h"
#include "groups/groups.h"
#include "inputs/open_source.h"
#include "inputs/request.h"
#include "pdc/sample/crease_points.h"
#include "pdc/study/sweep_writer.h"
#include "polite_run.h"

namespace pdc::python {
namespace {

const std::vector<std::pair<std::string, SweepParameter>> kParameters{{"sigma_normal", SweepParameter::kSigmaNormal},
                                                                      {"level", SweepParameter::kIso},
                                                                      {"voxel_size", SweepParameter::kVoxelSize},
                                                                      {"adaptive", SweepParameter::kAdaptive}};

SweepTruth truthOf(const Input& input, const Monitor& monitor) {
  if (input.field == nullptr) return {};
  return {.field = input.field,
          .reference = nullptr,
          .creases = creasePoints(input.field, *input.source, {.progress = {}, .stop = monitor.stop})};
}

SweepInput toSweepInput(Input input, const Monitor& monitor) {
  SweepTruth truth = truthOf(input, monitor);
  return {std::move(input.source), std::move(truth)};
}

Sweep run(const std::vector<OpenInput>& opens, SweepParameter parameter, const std::vector<double>& values,
          const MeshRequest& request, const Monitor& monitor) {
  SweepOptions options{.contour = request.contourOptions(kPapersSigmaNormal), .truth = {}};
  options.contour.origin.reset();
  if (request.adaptive)
    (request.adaptive->suffixed ? options.adaptive : options.contour.adaptive) = request.adaptive->value;
  if (parameter == SweepParameter::kIso || parameter == SweepParameter::kVoxelSize) {
    std::size_t next = 0;
    return sweepInputs(
        parameter, values, [&](double) { return toSweepInput(opens[next++](monitor), monitor); }, options, monitor);
  }
  Input first = opens.front()(monitor);
  options.contour.adaptiveScale = std::move(first.adaptiveScale);
  SweepInput input = toSweepInput(std::move(first), monitor);
  options.truth = std::move(input.truth);
  return parameter == SweepParameter::kSigmaNormal ? sweepSigma(*input.source, values, options, monitor)
                                                   : sweepAdaptive(*input.source, values, options, monitor);
}

std::pair<py::object, std::vector<MeshHandle>> sweep(const py::tuple& source, const std::string& parameter,
                                                     const std::vector<double>& values, const py::dict& given,
                                                     const py::object& progress) {
  const SweepParameter swept = valueOf(kParameters, "parameter", parameter);
  MeshRequest request = requestOf(given);
  std::vector<OpenInput> opens;
  for (const double value : values) {
    MeshRequest step = request;
    if (swept == SweepParameter::kIso) step.iso = value;
    if (swept == SweepParameter::kVoxelSize) step.voxelSize = value;
    opens.push_back(withGrids(openSource(source, step), GivenOptions(given)));
  }
  Sweep result =
      makePolitely(progress, [&](const Monitor& monitor) { return run(opens, swept, values, request, monitor); });
  const auto report = nlohmann::ordered_json::parse(sweepJson(result, {.title = {}, .command = {}, .pictures = {}}));
  std::vector<MeshHandle> meshes;
  for (Mesh& mesh : result.meshes) meshes.emplace_back(std::move(mesh));
  return {toPython(report), std::move(meshes)};
}

}  // namespace

void addSweep(py::module_& module) { module.def("sweep", &sweep); }

}  // namespace pdc::python
