#include "inputs/open_source.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "inputs/callable_field.h"
#include "inputs/dense_array.h"
#include "inputs/grid_handle.h"
#include "io/vdb/grid_warnings.h"
#include "pdc/sample/dense/dense_source.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc::python {
namespace {

/// What a grid's and an array's source have in common.
template <typename Source>
Input inputOf(std::unique_ptr<const Source> source, const char* kind) {
  Input input;
  input.iso = source->iso();
  input.planeOrigin = source->usesDistances() ? PlaneOrigin::kDistance : PlaneOrigin::kGradient;
  input.valueNoise = source->valueNoise();
  input.refusedNoise = source->refusedNoise();
  input.meaning = source->meaning();
  input.warnings = detail::gridWarnings(source->meaning(), detail::OptionStyle::kPython);
  input.whyEmpty = [kind, iso = input.iso] { return fmt::format("the {} has no surface at level {}", kind, iso); };
  input.source = std::move(source);
  return input;
}

std::optional<VolumeView> companion(const py::object& array) {
  if (array.is_none()) return std::nullopt;
  return viewOf(array.cast<py::array>());
}

OpenInput openFile(const MeshRequest& request) {
  return [path = request.input, options = request.inputOptions()](const Monitor& monitor) {
    return openInput(path, options, monitor);
  };
}

openvdb::GridBase::ConstPtr gridOrNull(const py::object& object) {
  return object.is_none() ? nullptr : object.cast<GridHandle>().grid;
}

OpenInput openGrid(const py::tuple& parts, const MeshRequest& request) {
  const GridSourceOptions options{.iso = request.iso,
                                  .open = request.open,
                                  .acceptNonFinite = request.acceptNonFinite.value_or(false),
                                  .hermite = request.hermite.value_or(HermiteMode::kAuto),
                                  .sigma = gridOrNull(parts[2]),
                                  .weight = gridOrNull(parts[3]),
                                  .gridClass = request.gridClass,
                                  .inside = request.inside,
                                  .floodFill = request.floodFill};
  return [grid = gridOrNull(parts[1]), options](const Monitor&) {
    auto source = std::make_unique<const GridSource>(grid, options);
    const std::size_t withoutData = source->crossingsWithoutData();
    Input input = inputOf(std::move(source), "grid");
    input.crossingsWithoutData = withoutData;
    return input;
  };
}

OpenInput openField(const py::tuple& parts, const MeshRequest& request) {
  const auto box = parts[2].cast<std::array<double, 6>>();
  const FieldSourceOptions options{.box = {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}},
                                   .voxelSize = request.voxelSize.value_or(0),
                                   .iso = request.iso.value_or(0),
                                   .open = request.open,
                                   .acceptNonFinite = request.acceptNonFinite.value_or(false)};
  return [field = parts[1].cast<FieldHandle>().field, options,
          sigma = parts[3].cast<std::optional<double>>()](const Monitor&) {
    auto source = std::make_unique<const FieldSource>(field, options);
    Input input;
    input.iso = options.iso;
    input.sigmaNormal = sigma;
    input.field = source->levelField();
    if (!options.open) input.cut = options.box;
    input.planeOrigin = PlaneOrigin::kFunction;
    input.whyEmpty = [iso = options.iso] {
      return fmt::format("the field has no surface at level {} in its box", iso);
    };
    input.source = std::move(source);
    return input;
  };
}

OpenInput openArray(const py::tuple& parts, const MeshRequest& request) {
  const DenseSourceOptions options{.iso = request.iso,
                                   .open = request.open,
                                   .acceptNonFinite = request.acceptNonFinite.value_or(false),
                                   .hermite = request.hermite.value_or(HermiteMode::kAuto),
                                   .gridClass = request.gridClass,
                                   .inside = request.inside,
                                   .sigma = companion(parts[3]),
                                   .weight = companion(parts[4]),
                                   .mask = companion(parts[5])};
  return [view = viewOf(parts[1].cast<py::array>()), map = mapOf(parts[2].cast<py::array_t<double>>()), options](
             const Monitor&) { return inputOf(std::make_unique<const DenseSource>(view, map, options), "array"); };
}

}  // namespace

OpenInput openSource(const py::tuple& source, MeshRequest& request) {
  const auto kind = source[0].cast<std::string>();
  request.input = kind == "file" ? source[1].cast<std::filesystem::path>() : std::filesystem::path(kind);
  if (kind == "file") return openFile(request);
  if (kind == "grid") return openGrid(source, request);
  if (kind == "field") return openField(source, request);
  return openArray(source, request);
}

}  // namespace pdc::python
