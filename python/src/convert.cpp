#include "convert.h"

namespace pdc::python {

py::object toPython(const nlohmann::ordered_json& json) {
  using Type = nlohmann::ordered_json::value_t;
  switch (json.type()) {
    case Type::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[py::str(key)] = toPython(value);
      return dict;
    }
    case Type::array: {
      py::list list;
      for (const auto& value : json) list.append(toPython(value));
      return list;
    }
    case Type::string:
      return py::str(json.get<std::string>());
    case Type::boolean:
      return py::bool_(json.get<bool>());
    case Type::number_integer:
      return py::int_(json.get<long long>());
    case Type::number_unsigned:
      return py::int_(json.get<unsigned long long>());
    case Type::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

py::array_t<double> toArray(const Vec3d& v) {
  py::array_t<double> array(3);
  for (int i = 0; i < 3; ++i) array.mutable_at(i) = v[i];
  return array;
}

py::array_t<double> toArray(const Mat3d& linear, const Vec3d& translation) {
  py::array_t<double> array({4, 4});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) array.mutable_at(row, column) = linear.row[row][column];
    array.mutable_at(row, 3) = translation[row];
    array.mutable_at(3, row) = 0;
  }
  array.mutable_at(3, 3) = 1;
  return array;
}

}  // namespace pdc::python
