#include "inputs/dense_array.h"

#include <bit>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "convert.h"

namespace pdc::python {
namespace {

namespace py = pybind11;

std::optional<ScalarType> scalarType(char kind, py::ssize_t bytes) {
  if (kind == 'b') return ScalarType::kBool;
  if (kind == 'f') {
    if (bytes == 2) return ScalarType::kFloat16;
    if (bytes == 4) return ScalarType::kFloat32;
    if (bytes == 8) return ScalarType::kFloat64;
  }
  if (kind == 'i' || kind == 'u') {
    const bool isSigned = kind == 'i';
    if (bytes == 1) return isSigned ? ScalarType::kInt8 : ScalarType::kUint8;
    if (bytes == 2) return isSigned ? ScalarType::kInt16 : ScalarType::kUint16;
    if (bytes == 4) return isSigned ? ScalarType::kInt32 : ScalarType::kUint32;
    if (bytes == 8) return isSigned ? ScalarType::kInt64 : ScalarType::kUint64;
  }
  return std::nullopt;
}

/// NumPy's letter for a kind of numbers.
char codeOf(ScalarType type) {
  switch (type) {
    case ScalarType::kBool:
      return 'b';
    case ScalarType::kInt8:
    case ScalarType::kInt16:
    case ScalarType::kInt32:
    case ScalarType::kInt64:
      return 'i';
    case ScalarType::kUint8:
    case ScalarType::kUint16:
    case ScalarType::kUint32:
    case ScalarType::kUint64:
      return 'u';
    case ScalarType::kFloat16:
    case ScalarType::kFloat32:
    case ScalarType::kFloat64:
      return 'f';
  }
  return 0;
}

}  // namespace

VolumeView viewOf(const py::array& array) {
  const py::dtype dtype = array.dtype();
  const std::optional<ScalarType> type = scalarType(dtype.kind(), dtype.itemsize());
  if (!type) throw py::type_error("values must be bool, integers or floats of at most 64 bits, not " + textOf(dtype));
  VolumeView view;
  view.data = static_cast<const std::byte*>(array.data());
  view.type = *type;
  const char order = dtype.attr("byteorder").cast<char>();
  view.swapped = order == (std::endian::native == std::endian::little ? '>' : '<');
  for (int axis = 0; axis < 3; ++axis) {
    view.size[axis] = array.shape(axis);
    view.stride[axis] = array.strides(axis);
  }
  return view;
}

py::array arrayOf(const VolumeView& view, const std::shared_ptr<const void>& owner) {
  const bool little = (std::endian::native == std::endian::little) != view.swapped;
  const py::dtype dtype(std::string(little ? "<" : ">") + codeOf(view.type) + std::to_string(sizeOf(view.type)));
  std::vector<py::ssize_t> shape(view.size.begin(), view.size.end()), strides(view.stride.begin(), view.stride.end());
  py::array array(dtype, std::move(shape), std::move(strides), view.data, capsuleOf(owner));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

LatticeMap mapOf(const py::array_t<double>& affine) {
  Mat3d linear;
  Vec3d translation{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) linear.row[row][column] = affine.at(row, column);
    translation[row] = affine.at(row, 3);
  }
  return {linear, translation};
}

}  // namespace pdc::python
