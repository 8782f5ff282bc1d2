#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <istream>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "convert.h"
#include "groups/groups.h"
#include "inputs/grid_handle.h"
#include "pdc/error.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/io/vdb/vdb_writer.h"
#include "polite_run.h"
#include "sample/meaning/contourable_grids.h"
#include "sample/meaning/grid_map.h"

namespace pdc::python {
namespace {

using detail::ContourableGrids;
using Corner = std::array<std::int32_t, 3>;

/// Bytes that somebody else owns, as a stream reads them.
class ByteSource final : public std::streambuf {
 public:
  explicit ByteSource(std::string_view bytes) {
    char* const begin = const_cast<char*>(bytes.data());  // A streambuf that is only read from changes nothing.
    setg(begin, begin, begin + bytes.size());
  }
};

/// OpenVDB's transform of an affine matrix that takes indices, as columns, to the world.
openvdb::math::Transform::Ptr transformOf(const py::array_t<double>& affine) {
  openvdb::Mat4d matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix(column, row) = affine.at(row, column);
  return openvdb::math::Transform::createLinearTransform(matrix);
}

template <typename GridT>
using DenseValues = openvdb::tools::Dense<typename GridT::ValueType, openvdb::tools::LayoutZYX>;

/// The grid of an array in C order; values that are the background's are inactive.
template <typename GridT>
GridHandle fromDense(const py::array& array, const py::array_t<double>& affine, double background,
                     const std::string& gridClass) {
  using Value = typename GridT::ValueType;
  const openvdb::Coord size(static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)),
                            static_cast<int>(array.shape(2)));
  auto* const values = static_cast<Value*>(const_cast<void*>(array.data()));  // copyFromDense() only reads.
  auto grid = GridT::create(static_cast<Value>(background));
  grid->setTransform(transformOf(affine));
  grid->setGridClass(openvdb::GridBase::stringToGridClass(gridClass));
  static_cast<void>(detail::gridMap(*grid));
  return makePolitely(py::none(), [&](const Monitor&) {
    const DenseValues<GridT> dense(openvdb::CoordBBox(openvdb::Coord(0), size - openvdb::Coord(1)), values);
    openvdb::tools::copyFromDense(dense, *grid, Value{});
    return GridHandle{grid};
  });
}

GridHandle fromArray(const py::array& array, const py::array_t<double>& affine, double background,
                     const std::string& gridClass) {
  if (py::isinstance<py::array_t<float>>(array))
    return fromDense<openvdb::FloatGrid>(array, affine, background, gridClass);
  if (py::isinstance<py::array_t<double>>(array))
    return fromDense<openvdb::DoubleGrid>(array, affine, background, gridClass);
  if (py::isinstance<py::array_t<std::int32_t>>(array))
    return fromDense<openvdb::Int32Grid>(array, affine, background, gridClass);
  if (py::isinstance<py::array_t<std::int64_t>>(array))
    return fromDense<openvdb::Int64Grid>(array, affine, background, gridClass);
  if (py::isinstance<py::array_t<bool>>(array))
    return fromDense<openvdb::BoolGrid>(array, affine, background, gridClass);
  throw py::type_error("no grid holds values of type " + textOf(array.dtype()));
}

template <typename GridT>
py::array toDense(const GridT& grid, const Corner& lo, const Corner& hi) {
  using Value = typename GridT::ValueType;
  const openvdb::CoordBBox box(openvdb::Coord(lo[0], lo[1], lo[2]), openvdb::Coord(hi[0], hi[1], hi[2]));
  py::array_t<Value> array({box.dim().x(), box.dim().y(), box.dim().z()});
  Value* const values = array.mutable_data();
  runPolitely(py::none(), [&](const Monitor&) {
    DenseValues<GridT> dense(box, values);
    openvdb::tools::copyToDense(grid, dense);
  });
  return array;
}

py::array toArrayOf(const GridHandle& self, const Corner& lo, const Corner& hi) {
  py::array array;
  const bool known = self.grid->apply<ContourableGrids>([&](const auto& grid) { array = toDense(grid, lo, hi); });
  if (!known) throw Error("a grid of type " + self.grid->valueType() + " has no values that an array could hold");
  return array;
}

double backgroundOf(const GridHandle& self) {
  double background = 0;
  self.grid->apply<ContourableGrids>([&](const auto& grid) { background = static_cast<double>(grid.background()); });
  return background;
}

py::array_t<double> affineOf(const GridHandle& self) {
  if (!self.grid->transform().isLinear()) throw Error("the grid's transform is a frustum, which no matrix describes");
  const openvdb::Mat4d matrix = self.grid->transform().baseMap()->getAffineMap()->getMat4();
  py::array_t<double> affine({4, 4});
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) affine.mutable_at(row, column) = matrix(column, row);
  return affine;
}

/// The inclusive box of active voxels, or None.
py::object activeBox(const GridHandle& self) {
  const openvdb::CoordBBox box = self.grid->evalActiveVoxelBoundingBox();
  if (box.empty()) return py::none();
  const auto tuple = [](const openvdb::Coord& c) { return py::make_tuple(c.x(), c.y(), c.z()); };
  return py::make_tuple(tuple(box.min()), tuple(box.max()));
}

/// The first grid of a stream that OpenVDB wrote.
GridHandle fromBytes(const py::bytes& bytes) {
  const std::string_view view = bytes;
  return makePolitely(py::none(), [&](const Monitor&) {
    ByteSource source(view);
    std::istream stream(&source);
    const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(stream, false).getGrids();
    if (!grids || grids->empty()) throw Error("the stream holds no grid");
    return GridHandle{grids->front()};
  });
}

/// A grid that pdc._openvdb lends.
GridHandle fromCapsule(const py::capsule& capsule) {
  const auto* const grid = static_cast<const openvdb::GridBase::Ptr*>(capsule.get_pointer());
  if (capsule.name() != std::string_view("openvdb::GridBase::Ptr")) throw py::type_error("the capsule holds no grid");
  return GridHandle{*grid};
}

std::string toBytes(const GridHandle& self) {
  return makePolitely(py::none(), [&](const Monitor&) {
    std::ostringstream stream(std::ios::binary);
    openvdb::io::Stream(stream).write(openvdb::GridCPtrVec{self.grid});
    return std::move(stream).str();
  });
}

GridHandle read(const std::filesystem::path& path, const std::string& name) {
  return makePolitely(py::none(), [&](const Monitor&) { return GridHandle{readVdbGrid(path, name)}; });
}

std::size_t save(const GridHandle& self, const std::filesystem::path& path) {
  return makePolitely(py::none(), [&](const Monitor&) { return writeVdb(self.grid, path); });
}

}  // namespace

void addGrids(py::module_& module) {
  py::class_<GridHandle>(module, "Grid")
      .def_property_readonly("name", [](const GridHandle& self) { return self.grid->getName(); })
      .def_property_readonly("value_type", [](const GridHandle& self) { return self.grid->valueType(); })
      .def_property_readonly(
          "grid_class",
          [](const GridHandle& self) { return openvdb::GridBase::gridClassToString(self.grid->getGridClass()); })
      .def_property_readonly("active_voxels", [](const GridHandle& self) { return self.grid->activeVoxelCount(); })
      .def_property_readonly("background", &backgroundOf)
      .def_property_readonly("active_box", &activeBox)
      .def_property_readonly("affine", &affineOf)
      .def("to_array", &toArrayOf)
      .def("to_bytes", [](const GridHandle& self) { return py::bytes(toBytes(self)); })
      .def("save", &save);
  module.def("grid_from_array", &fromArray);
  module.def("grid_from_bytes", &fromBytes);
  module.def("grid_from_capsule", &fromCapsule);
  module.def("read_grid", &read);
}

}  // namespace pdc::python
