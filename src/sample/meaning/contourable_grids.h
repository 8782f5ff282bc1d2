#pragma once

#include <openvdb/openvdb.h>

#include <string>
#include <type_traits>

namespace pdc::detail {

/// The types of grids that can be contoured: scalars on trees whose leaves have 8³ voxels.
using ContourableGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid,
                                           openvdb::Int64Grid, openvdb::BoolGrid>;

/// Calls visit(std::type_identity<GridT>) for each of them, in order.
template <typename Visit>
void forEachContourableType(Visit&& visit) {
  const auto visitAll = [&]<typename... GridT>(openvdb::TypeList<GridT...>) {
    (visit(std::type_identity<GridT>{}), ...);
  };
  visitAll(ContourableGrids{});
}

/// Calls visit(grid) with the grid's own type. \returns false, without a call, for a grid that cannot be contoured.
template <typename Visit>
bool visitContourable(const openvdb::GridBase& grid, Visit&& visit) {
  return grid.apply<ContourableGrids>(visit);
}

/// The value types, as errors name them: "float, …, int64 and bool".
inline std::string contourableTypeNames() {
  std::string names;
  std::size_t left = ContourableGrids::Size;
  forEachContourableType([&]<typename GridT>(std::type_identity<GridT>) {
    names += openvdb::typeNameAsString<typename GridT::ValueType>();
    --left;
    names += left > 1 ? ", " : left == 1 ? " and " : "";
  });
  return names;
}

}  // namespace pdc::detail
