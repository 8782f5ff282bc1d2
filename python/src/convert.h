#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "pdc/math/mat3.h"
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

/// Keeps something alive as long as Python has this.
[[nodiscard]] inline py::capsule capsuleOf(const std::shared_ptr<const void>& owner) {
  return {new std::shared_ptr<const void>(owner), [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); }};
}

/// Numbers where they lie, read-only: `owner` lives as long as the array and all arrays made of it.
template <typename Number>
[[nodiscard]] py::array viewOf(const Number* numbers, std::vector<py::ssize_t> shape,
                               const std::shared_ptr<const void>& owner) {
  // NumPy would take memory of its own in place of a null pointer.
  static constexpr Number kNothing{};
  py::array array(py::dtype::of<Number>(), std::move(shape), numbers != nullptr ? numbers : &kNothing,
                  capsuleOf(owner));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Rows of some numbers each, in C order, as the Python files give them.
template <typename Number>
using Rows = py::array_t<Number, py::array::c_style>;

/// Each row of an array becomes one Row of as many numbers.
template <typename Row, typename Number>
void copyRows(const Rows<Number>& from, Buffer<Row>& to) {
  static_assert(std::is_trivially_copyable_v<Row> && sizeof(Row) % sizeof(Number) == 0);
  to.resize(static_cast<std::size_t>(from.shape(0)));
  std::copy_n(reinterpret_cast<const std::byte*>(from.data()), to.size() * sizeof(Row),
              reinterpret_cast<std::byte*>(to.data()));
}

/// What str() makes of it.
[[nodiscard]] inline std::string textOf(py::handle object) { return py::str(object); }

/// An array of three numbers.
[[nodiscard]] py::array_t<double> toArray(const Vec3d& v);

/// An affine matrix of 4 × 4 numbers.
[[nodiscard]] py::array_t<double> toArray(const Mat3d& linear, const Vec3d& translation);

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
