#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <variant>

#include "convert.h"
#include "groups/groups.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "polite_run.h"
#include "remedies.h"

namespace pdc::python {
namespace {

py::ssize_t count(std::size_t n) { return static_cast<py::ssize_t>(n); }

MeshHandle fromArrays(const Rows<float>& vertices, const Rows<std::uint32_t>& quads,
                      const Rows<std::uint32_t>& triangles, const Rows<float>& normals) {
  Mesh mesh;
  copyRows(vertices, mesh.positions);
  copyRows(quads, mesh.quads);
  copyRows(triangles, mesh.triangles);
  copyRows(normals, mesh.normals);
  return MeshHandle(std::move(mesh));
}

template <typename Number>
bool takeNumbers(const py::array& array, VertexProperty& property) {
  if (!py::isinstance<py::array_t<Number>>(array)) return false;
  const Rows<Number> rows(array);
  Buffer<Number> numbers(static_cast<std::size_t>(rows.size()));
  std::copy_n(rows.data(), numbers.size(), numbers.data());
  property.values = std::move(numbers);
  return true;
}

/// A copy with one more property, or with another one under that name.
MeshHandle withProperty(const MeshHandle& self, const std::string& name, const py::array& array) {
  VertexProperty property{.name = name, .components = array.ndim() == 2 ? static_cast<int>(array.shape(1)) : 1};
  const bool taken = takeNumbers<std::int8_t>(array, property) || takeNumbers<std::uint8_t>(array, property) ||
                     takeNumbers<std::int16_t>(array, property) || takeNumbers<std::uint16_t>(array, property) ||
                     takeNumbers<std::int32_t>(array, property) || takeNumbers<std::uint32_t>(array, property) ||
                     takeNumbers<float>(array, property) || takeNumbers<double>(array, property);
  if (!taken) throw py::type_error("property '" + name + "' has a type that no mesh holds");
  Mesh mesh = *self.mesh;
  const auto old =
      std::find_if(mesh.properties.begin(), mesh.properties.end(), [&](const auto& p) { return p.name == name; });
  if (old == mesh.properties.end())
    mesh.properties.push_back(std::move(property));
  else
    *old = std::move(property);
  return MeshHandle(std::move(mesh));
}

py::array positions(const MeshHandle& self) {
  const auto& p = self.mesh->positions;
  return viewOf(reinterpret_cast<const float*>(p.data()), {count(p.size()), 3}, self.mesh);
}

py::array normals(const MeshHandle& self) {
  const auto& n = self.mesh->normals;
  return viewOf(reinterpret_cast<const float*>(n.data()), {count(n.size()), 3}, self.mesh);
}

py::array quads(const MeshHandle& self) {
  const auto& q = self.mesh->quads;
  return viewOf(reinterpret_cast<const std::uint32_t*>(q.data()), {count(q.size()), 4}, self.mesh);
}

py::array triangles(const MeshHandle& self) {
  const auto& t = self.mesh->triangles;
  return viewOf(reinterpret_cast<const std::uint32_t*>(t.data()), {count(t.size()), 3}, self.mesh);
}

/// All faces as triangles, those of the quads first.
py::array faces(const MeshHandle& self) {
  const Mesh& mesh = *self.mesh;
  if (mesh.quads.empty()) return triangles(self);
  auto all = std::make_shared<Buffer<Triangle>>(2 * mesh.quads.size() + mesh.triangles.size());
  {
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      const auto [a, b, c, d] = mesh.quads[i];
      (*all)[2 * i] = {a, b, c};
      (*all)[2 * i + 1] = {a, c, d};
    }
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), all->begin() + count(2 * mesh.quads.size()));
  }
  return viewOf(reinterpret_cast<const std::uint32_t*>(all->data()), {count(all->size()), 3}, all);
}

py::dict properties(const MeshHandle& self) {
  py::dict all;
  for (const VertexProperty& property : self.mesh->properties) {
    const auto view = [&](const auto& numbers) {
      std::vector<py::ssize_t> shape{count(self.mesh->positions.size())};
      if (property.components > 1) shape.push_back(property.components);
      return viewOf(numbers.data(), std::move(shape), self.mesh);
    };
    all[py::str(property.name)] = std::visit(view, property.values);
  }
  return all;
}

std::pair<MeshHandle, std::vector<std::string>> read(const std::filesystem::path& path) {
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& line) { warnings.push_back(line); };
  Mesh mesh = makePolitely(py::none(), [&](const Monitor&) { return readMesh(path, {.warn = warn}); });
  return {MeshHandle(std::move(mesh)), inPythonsWords(warnings)};
}

std::size_t save(const MeshHandle& self, const std::filesystem::path& path, bool ascii, bool doublePrecision,
                 const std::string& space, const std::string& unit) {
  const MeshWriteOptions options{.ascii = ascii, .doublePrecision = doublePrecision, .space = space, .unit = unit};
  return makePolitely(py::none(), [&](const Monitor&) { return writeMesh(*self.mesh, path, options); });
}

}  // namespace

void addMesh(py::module_& module) {
  py::class_<MeshHandle>(module, "Mesh")
      .def(py::init(&fromArrays), py::arg("vertices"), py::arg("quads"), py::arg("triangles"), py::arg("normals"))
      .def("with_property", &withProperty, py::arg("name"), py::arg("values"))
      .def_property_readonly("vertices", &positions)
      .def_property_readonly("normals", &normals)
      .def_property_readonly("quads", &quads)
      .def_property_readonly("triangles", &triangles)
      .def_property_readonly("faces", &faces)
      .def_property_readonly("properties", &properties)
      .def_property_readonly("origin", [](const MeshHandle& self) { return toArray(self.mesh->origin); })
      .def("save", &save, py::arg("path"), py::arg("ascii"), py::arg("double_precision"), py::arg("space"),
           py::arg("unit"));
  module.def("read_mesh", &read, py::arg("path"));
}

}  // namespace pdc::python
