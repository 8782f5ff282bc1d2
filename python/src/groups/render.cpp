#include "pdc/render/render.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "convert.h"
#include "groups/groups.h"
#include "pdc/io/png_writer.h"
#include "polite_run.h"

namespace pdc::python {
namespace {

/// Rows of pixels from the top, three bytes each.
py::array_t<std::uint8_t> toArray(const Image& image) {
  py::array_t<std::uint8_t> array({py::ssize_t{image.height}, py::ssize_t{image.width}, py::ssize_t{3}});
  std::copy_n(image.pixels.data()->data(), 3 * image.pixels.size(), array.mutable_data());
  return array;
}

py::array_t<std::uint8_t> draw(const MeshHandle& mesh, const py::dict& options, const py::object& values,
                               const py::object& progress) {
  RenderOptions render{.width = options["width"].cast<int>(),
                       .height = options["height"].cast<int>(),
                       .edges = options["edges"].cast<bool>(),
                       .threads = options["threads"].cast<int>()};
  if (const py::object view = options["view"]; py::isinstance<py::str>(view)) {
    const auto named = viewNamed(view.cast<std::string>());
    if (!named)
      throw py::value_error("view must be iso, front, back, left, right, top, bottom or a direction, not '" +
                            view.cast<std::string>() + "'");
    render.towardsViewer = *named;
  } else {
    const auto direction = view.cast<std::array<double, 3>>();
    render.towardsViewer = {direction[0], direction[1], direction[2]};
  }
  if (options["normals"].cast<bool>()) render.shading = Shading::kNormal;
  py::array_t<float, py::array::c_style> shown;
  if (!values.is_none()) {
    shown = values.cast<py::array_t<float, py::array::c_style>>();
    render.shading = Shading::kValues;
    render.values = {shown.data(), static_cast<std::size_t>(shown.size())};
    render.valueLo = options["low"].cast<float>();
    render.valueHi = options["high"].cast<float>();
  }
  return toArray(
      makePolitely(progress, [&](const Monitor& monitor) { return pdc::render(*mesh.mesh, render, monitor); }));
}

using Pixels = py::array_t<std::uint8_t, py::array::c_style>;

Image toImage(const Pixels& pixels) {
  Image image{static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), {}};
  image.pixels.resize(static_cast<std::size_t>(pixels.size()) / 3);
  std::copy_n(pixels.data(), pixels.size(), image.pixels.data()->data());
  return image;
}

py::bytes encode(const Pixels& pixels) {
  const std::vector<std::uint8_t> png = encodePng(toImage(pixels));
  return {reinterpret_cast<const char*>(png.data()), png.size()};
}

std::size_t write(const Pixels& pixels, const std::filesystem::path& path) { return writePng(toImage(pixels), path); }

}  // namespace

void addRender(py::module_& module) {
  module.def("render", &draw);
  module.def("encode_png", &encode);
  module.def("write_png", &write);
}

}  // namespace pdc::python
