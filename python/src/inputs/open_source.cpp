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
#include <vector>

#include "convert.h"
#include "inputs/callable_field.h"
#include "inputs/dense_array.h"
#include "inputs/grid_handle.h"
#include "inputs/volume_handle.h"
#include "io/open_mesh.h"
#include "io/open_volume.h"
#include "io/vdb/grid_warnings.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_function.h"

namespace pdc::python {
namespace {

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
  const auto handle = parts[1].cast<GridHandle>();
  GridSourceOptions options{.iso = request.iso,
                            .open = request.open,
                            .acceptNonFinite = request.acceptNonFinite.value_or(false),
                            .hermite = request.hermite.value_or(HermiteMode::kAuto),
                            .sigma = gridOrNull(parts[2]),
                            .weight = gridOrNull(parts[3]),
                            .gridClass = request.gridClass,
                            .inside = request.inside,
                            .floodFill = request.floodFill};
  if (const auto& settled = handle.settled) {
    if (!options.iso) options.iso = settled->iso;
    if (!options.gridClass) options.gridClass = settled->gridClass;
    if (!options.inside) options.inside = settled->inside;
  }
  return [grid = openvdb::GridBase::ConstPtr(handle.grid), options](const Monitor&) {
    auto source = std::make_unique<const GridSource>(grid, options);
    Input input;
    input.iso = source->iso();
    input.planeOrigin = source->usesDistances() ? PlaneOrigin::kDistance : PlaneOrigin::kGradient;
    input.valueNoise = source->valueNoise();
    input.refusedNoise = source->refusedNoise();
    input.crossingsWithoutData = source->crossingsWithoutData();
    input.meaning = source->meaning();
    input.warnings = detail::gridWarnings(source->meaning(), detail::OptionStyle::kProgram);
    input.whyEmpty = [iso = input.iso] { return fmt::format("the grid has no surface at level {}", iso); };
    input.source = std::move(source);
    return input;
  };
}

OpenInput openMeshOf(const py::tuple& parts, const MeshRequest& request) {
  const InputOptions options{.voxelSize = request.voxelSize,
                             .resolution = request.resolution,
                             .offset = request.steps.steps.offset,
                             .shell = request.shell};
  return [mesh = parts[1].cast<MeshHandle>(), options](const Monitor& monitor) {
    return detail::openMesh(*mesh.mesh, options, monitor);
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

/// A dense volume in memory, and the arrays that go with it.
OpenInput openDense(DenseVolume volume, const py::tuple& companions, const MeshRequest& request) {
  const detail::OpenVolumeOptions options{.read = {},
                                          .source = {.iso = request.iso,
                                                     .open = request.open,
                                                     .acceptNonFinite = request.acceptNonFinite.value_or(false),
                                                     .hermite = request.hermite.value_or(HermiteMode::kAuto),
                                                     .gridClass = request.gridClass,
                                                     .inside = request.inside,
                                                     .sigma = companion(companions[0]),
                                                     .weight = companion(companions[1]),
                                                     .mask = companion(companions[2])},
                                          .isoFromOtsu = request.isoFromOtsu};
  return [volume = std::move(volume), options](const Monitor& monitor) {
    Input input = detail::inputOf(detail::openVolume(volume, options, monitor));
    input.whyEmpty = [iso = input.iso] { return fmt::format("the volume has no surface at level {}", iso); };
    return input;
  };
}

OpenInput openArray(const py::tuple& parts, const MeshRequest& request) {
  const LatticeMap map = mapOf(parts[2].cast<py::array_t<double>>());
  DenseVolume volume;
  volume.view = viewOf(parts[1].cast<py::array>());
  volume.linear = map.jacobian({});
  volume.translation = map.position({});
  const OpenInput open = openDense(std::move(volume), parts[3].cast<py::tuple>(), request);
  return [open](const Monitor& monitor) {
    Input input = open(monitor);
    input.volume.reset();  // It is of no file.
    return input;
  };
}

OpenInput openVolumeOf(const py::tuple& parts, const MeshRequest& request) {
  DenseVolume volume = *parts[1].cast<VolumeHandle>().volume;
  volume.warnings.clear();  // They were given when it was read.
  return openDense(std::move(volume), parts[2].cast<py::tuple>(), request);
}

}  // namespace

OpenInput openSource(const py::tuple& source, MeshRequest& request) {
  const auto kind = source[0].cast<std::string>();
  request.input = kind == "file" ? source[1].cast<std::filesystem::path>() : std::filesystem::path(kind);
  if (kind == "file") return openFile(request);
  if (kind == "grid") return openGrid(source, request);
  if (kind == "field") return openField(source, request);
  if (kind == "mesh") return openMeshOf(source, request);
  if (kind == "volume") return openVolumeOf(source, request);
  return openArray(source, request);
}

OpenInput withGrids(OpenInput open, const GivenOptions& options) {
  std::vector<InputAttribute> attributes;
  if (const py::object given = options.given("attribute_grids"); !given.is_none())
    for (const auto& [name, grid] : given.cast<std::vector<std::pair<std::string, GridHandle>>>())
      attributes.push_back({name, grid.grid});
  const openvdb::GridBase::ConstPtr scale = gridOrNull(options.given("adaptive_scale"));
  if (attributes.empty() && !scale) return open;
  return [open = std::move(open), attributes, scale](const Monitor& monitor) {
    Input input = open(monitor);
    input.attributes.insert(input.attributes.end(), attributes.begin(), attributes.end());
    if (scale) input.adaptiveScale = gridFunction(scale);
    return input;
  };
}

}  // namespace pdc::python
