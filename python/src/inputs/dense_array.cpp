#include "inputs/dense_array.h"

#include <bit>
#include <optional>
#include <string>

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
