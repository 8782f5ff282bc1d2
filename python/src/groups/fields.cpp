#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <utility>

#include "convert.h"
#include "groups/groups.h"
#include "inputs/callable_field.h"
#include "pdc/field/formula.h"
#include "pdc/field/mesh_field.h"
#include "pdc/field/noise.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/io/scene/scene_reader.h"
#include "polite_run.h"

namespace pdc::python {
namespace {

using Point = std::array<double, 3>;
using Operands = std::vector<FieldHandle>;

Vec3d vec(const Point& p) { return {p[0], p[1], p[2]}; }

std::vector<FieldPtr> fieldsOf(const Operands& operands) {
  std::vector<FieldPtr> fields;
  for (const FieldHandle& operand : operands) fields.push_back(operand.field);
  return fields;
}

using Points = py::array_t<double, py::array::c_style>;

/// Calls visit(batch, first) for the points in batches as fields take them.
template <typename Visit>
void forEachBatch(const Points& points, const Visit& visit) {
  std::array<double, Field::kMaxBatch> x, y, z;
  const auto n = static_cast<std::size_t>(points.shape(0));
  const double* const from = points.data();
  const py::gil_scoped_release release;
  for (std::size_t first = 0; first < n; first += Field::kMaxBatch) {
    const std::size_t size = std::min(Field::kMaxBatch, n - first);
    for (std::size_t i = 0; i < size; ++i) {
      x[i] = from[3 * (first + i)];
      y[i] = from[3 * (first + i) + 1];
      z[i] = from[3 * (first + i) + 2];
    }
    visit(PointSpan{x.data(), y.data(), z.data(), size}, first);
  }
}

py::array_t<double> valuesAt(const FieldHandle& self, const Points& points) {
  py::array_t<double> values(points.shape(0));
  double* const to = values.mutable_data();
  forEachBatch(points, [&](PointSpan batch, std::size_t first) { self.field->values(batch, to + first); });
  return values;
}

py::array_t<double> gradientsAt(const FieldHandle& self, const Points& points) {
  py::array_t<double> gradients({points.shape(0), py::ssize_t{3}});
  double* const to = gradients.mutable_data();
  std::array<double, Field::kMaxBatch> values, x, y, z;
  forEachBatch(points, [&](PointSpan batch, std::size_t first) {
    self.field->gradients(batch, values.data(), {x.data(), y.data(), z.data()});
    for (std::size_t i = 0; i < batch.size; ++i) {
      double* const g = to + 3 * (first + i);
      g[0] = x[i];
      g[1] = y[i];
      g[2] = z[i];
    }
  });
  return gradients;
}

void addPrimitives(py::module_& m) {
  m.def("sphere", [](const Point& center, double radius) { return FieldHandle{sphere(vec(center), radius)}; });
  m.def("box", [](const Point& center, const Point& size) { return FieldHandle{box(vec(center), vec(size) * 0.5)}; });
  m.def("rounded_box", [](const Point& center, const Point& size, double radius) {
    return FieldHandle{roundedBox(vec(center), vec(size) * 0.5, radius)};
  });
  m.def("plane", [](const Point& point, const Point& normal) { return FieldHandle{plane(vec(point), vec(normal))}; });
  m.def("cylinder", [](const Point& from, const Point& to, double radius) {
    return FieldHandle{cylinder(vec(from), vec(to), radius)};
  });
  m.def("capped_cone", [](const Point& from, const Point& to, double radiusFrom, double radiusTo) {
    return FieldHandle{cappedCone(vec(from), vec(to), radiusFrom, radiusTo)};
  });
  m.def("torus", [](const Point& center, const Point& axis, double radius, double tube) {
    return FieldHandle{torus(vec(center), vec(axis), radius, tube)};
  });
  m.def("capsule", [](const Point& from, const Point& to, double radius) {
    return FieldHandle{capsule(vec(from), vec(to), radius)};
  });
  m.def("ellipsoid",
        [](const Point& center, const Point& semiAxes) { return FieldHandle{ellipsoid(vec(center), vec(semiAxes))}; });
  m.def("gyroid", [](double period, double thickness) { return FieldHandle{gyroid(period, thickness)}; });
  m.def("simplex_noise",
        [](std::uint32_t seed, int octaves, double frequency, double gain, double lacunarity, double amplitude) {
          return FieldHandle{simplexNoise({seed, octaves, frequency, gain, lacunarity, amplitude})};
        });
  m.def("formula", [](const std::string& expression, std::optional<double> lipschitz) {
    return FieldHandle{formula(expression, lipschitz)};
  });
  m.def("function", [](const py::object& f, const py::object& gradient, std::optional<double> lipschitz) {
    return FieldHandle{callableField(f, gradient, lipschitz)};
  });
}

FieldHandle fieldOfMesh(const MeshHandle& mesh, const py::object& progress) {
  return {makePolitely(progress, [&](const Monitor&) { return meshField(*mesh.mesh); })};
}

void addOperators(py::module_& m) {
  m.def("unite", [](const Operands& of, std::optional<double> smooth) {
    return FieldHandle{smooth ? smoothUnite(fieldsOf(of), *smooth) : unite(fieldsOf(of))};
  });
  m.def("intersect", [](const Operands& of, std::optional<double> smooth) {
    return FieldHandle{smooth ? smoothIntersect(fieldsOf(of), *smooth) : intersect(fieldsOf(of))};
  });
  m.def("subtract", [](const Operands& of, std::optional<double> smooth) {
    return FieldHandle{smooth ? smoothSubtract(fieldsOf(of), *smooth) : subtract(fieldsOf(of))};
  });
  m.def("complement", [](const FieldHandle& of) { return FieldHandle{complement(of.field)}; });
  m.def("offset", [](const FieldHandle& of, double distance) { return FieldHandle{offset(of.field, distance)}; });
  m.def("shell", [](const FieldHandle& of, double thickness) { return FieldHandle{shell(of.field, thickness)}; });
  m.def("translate", [](const FieldHandle& of, const Point& by) { return FieldHandle{translate(of.field, vec(by))}; });
  m.def("rotate", [](const FieldHandle& of, const Point& axis, double degrees) {
    return FieldHandle{rotate(of.field, vec(axis), degrees)};
  });
  m.def("scale", [](const FieldHandle& of, double factor) { return FieldHandle{scale(of.field, factor)}; });
  m.def("scale_axes", [](const FieldHandle& of, const Point& f) { return FieldHandle{scale(of.field, vec(f))}; });
  m.def("mirror", [](const FieldHandle& of, int axis) { return FieldHandle{mirror(of.field, axis)}; });
  m.def("repeat", [](const FieldHandle& of, const Point& period, const std::array<int, 3>& count) {
    return FieldHandle{repeat(of.field, vec(period), count)};
  });
}

/// What a scene's file says, by name.
py::dict readSceneFile(const std::filesystem::path& path) {
  const Scene scene = makePolitely(py::none(), [&](const Monitor&) { return readScene(path); });
  py::dict said;
  said["name"] = scene.name;
  said["lo"] = py::make_tuple(scene.box.lo.x, scene.box.lo.y, scene.box.lo.z);
  said["hi"] = py::make_tuple(scene.box.hi.x, scene.box.hi.y, scene.box.hi.z);
  said["voxel_size"] = scene.voxelSize;
  said["sigma_normal"] = scene.sigmaNormal;
  said["level"] = scene.iso;
  said["field"] = FieldHandle{scene.field};
  said["nan"] = scene.acceptNonFinite ? "outside" : "error";
  said["warnings"] = scene.warnings;
  return said;
}

}  // namespace

void addFields(py::module_& module) {
  py::class_<FieldHandle>(module, "Field").def("values", &valuesAt).def("gradients", &gradientsAt);
  addPrimitives(module);
  addOperators(module);
  module.def("mesh_field", &fieldOfMesh);
  module.def("read_scene", &readSceneFile);
}

}  // namespace pdc::python
