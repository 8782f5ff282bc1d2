#pragma once

#include <openvdb/openvdb.h>

#include <string>
#include <type_traits>

namespace pdc::detail {

/// The types of grids that can be contoured: scalars on trees whose leaves have 8³ voxels.
using ContourableGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid,
                                           openvdb::Int64Grid, openvdb::BoolGrid>;

/// The types of grids whose values can be sampled at vertices: those, and vectors.
using SampledGrids = ContourableGrids::Append<openvdb::Vec3SGrid, openvdb::Vec3DGrid, openvdb::Vec3IGrid>;

/// Calls visit(std::type_identity<GridT>) for each type of a list, in order.
template <typename Grids, typename Visit>
void forEachGridType(Visit&& visit) {
  const auto visitAll = [&]<typename... GridT>(openvdb::TypeList<GridT...>) {
    (visit(std::type_identity<GridT>{}), ...);
  };
  visitAll(Grids{});
}

/// Calls visit(std::type_identity<GridT>) for each type of grid that can be contoured.
template <typename Visit>
void forEachContourableType(Visit&& visit) {
  forEachGridType<ContourableGrids>(visit);
}

/// Calls visit(grid) with the grid's own type. \returns false, without a call, for a grid that cannot be contoured.
template <typename Visit>
bool visitContourable(const openvdb::GridBase& grid, Visit&& visit) {
  return grid.apply<ContourableGrids>(visit);
}

/// The value types of a list, as errors name them: "float, …, int64 and bool".
template <typename Grids>
std::string gridTypeNames() {
  std::string names;
  std::size_t left = Grids::Size;
  forEachGridType<Grids>([&]<typename GridT>(std::type_identity<GridT>) {
    names += openvdb::typeNameAsString<typename GridT::ValueType>();
    --left;
    names += left > 1 ? ", " : left == 1 ? " and " : "";
  });
  return names;
}

/// The value types of grids that can be contoured, as errors name them.
inline std::string contourableTypeNames() { return gridTypeNames<ContourableGrids>(); }

}  // namespace pdc::detail
