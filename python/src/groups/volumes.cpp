#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "convert.h"
#include "given_options.h"
#include "groups/groups.h"
#include "inputs/dense_array.h"
#include "inputs/request.h"
#include "inputs/volume_handle.h"
#include "polite_run.h"
#include "remedies.h"

namespace pdc::python {
namespace {

VolumeHandle read(const std::filesystem::path& path, const py::dict& given, const py::object& progress) {
  const VolumeReadOptions options = volumeOptionsOf(GivenOptions(given));
  DenseVolume volume =
      makePolitely(progress, [&](const Monitor& monitor) { return readVolume(path, options, monitor); });
  volume.warnings = inPythonsWords(volume.warnings);
  return {std::make_shared<const DenseVolume>(std::move(volume))};
}

template <typename Member>
auto text(Member DenseVolume::*member) {
  return [member](const VolumeHandle& self) { return (*self.volume).*member; };
}

}  // namespace

void addVolumes(py::module_& module) {
  py::class_<VolumeHandle>(module, "Volume")
      .def_property_readonly("stored", [](const VolumeHandle& self) { return arrayOf(self.volume->view, self.volume); })
      .def_property_readonly("slope", [](const VolumeHandle& self) { return self.volume->view.slope; })
      .def_property_readonly("intercept", [](const VolumeHandle& self) { return self.volume->view.intercept; })
      .def_property_readonly(
          "affine", [](const VolumeHandle& self) { return toArray(self.volume->linear, self.volume->translation); })
      .def_property_readonly("format", text(&DenseVolume::format))
      .def_property_readonly("encoding", text(&DenseVolume::encoding))
      .def_property_readonly("space", text(&DenseVolume::space))
      .def_property_readonly("unit", text(&DenseVolume::unit))
      .def_property_readonly("orientation", text(&DenseVolume::orientation))
      .def_property_readonly("spacing_known", text(&DenseVolume::spacingKnown))
      .def_property_readonly("warnings", text(&DenseVolume::warnings));
  module.def("read_volume", &read);
}

}  // namespace pdc::python
