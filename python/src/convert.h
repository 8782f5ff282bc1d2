#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pdc/math/vec3.h"
#include "pdc/mesh/mesh.h"

namespace pdc::python {

namespace py = pybind11;

/// What Python holds of a mesh. Shared with the arrays that look into it, so it never changes.
struct MeshHandle {
  std::shared_ptr<const Mesh> mesh;

  explicit MeshHandle(Mesh made) : mesh(std::make_shared<const Mesh>(std::move(made))) {}
};

/// The same as Python's dicts, lists, strings and numbers.
[[nodiscard]] py::object toPython(const nlohmann::ordered_json& json);

/// Numbers where they lie, read-only: `owner` lives as long as the array and all arrays made of it.
template <typename Number>
[[nodiscard]] py::array viewOf(const Number* numbers, std::vector<py::ssize_t> shape,
                               const std::shared_ptr<const void>& owner) {
  const py::capsule base(new std::shared_ptr<const void>(owner),
                         [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  // NumPy would take memory of its own in place of a null pointer.
  static constexpr Number kNothing{};
  py::array array(py::dtype::of<Number>(), std::move(shape), numbers != nullptr ? numbers : &kNothing, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// What str() makes of it.
[[nodiscard]] inline std::string textOf(py::handle object) { return py::str(object); }

/// An array of three numbers.
[[nodiscard]] py::array_t<double> toArray(const Vec3d& v);

/// The word's value. \throws py::value_error that names the argument and lists the words.
template <typename Value>
[[nodiscard]] Value valueOf(const std::vector<std::pair<std::string, Value>>& choices, const char* argument,
                            const std::string& word) {
  std::string words;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    words += (words.empty() ? "'" : ", '") + name + "'";
  }
  throw py::value_error(std::string(argument) + " must be one of " + words + ", not '" + word + "'");
}

}  // namespace pdc::python
