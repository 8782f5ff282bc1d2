#include "pdc/sample/vdb/grid_function.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include <stdexcept>

#include "pdc/error.h"
#include "sample/vdb/index_place.h"

namespace pdc {
namespace {

template <typename Grid>
std::function<double(const Vec3d&)> functionOf(std::shared_ptr<const Grid> grid) {
  // The tree itself, since accessors are for one thread.
  return [grid = std::move(grid)](const Vec3d& p) {
    const openvdb::Vec3d place = detail::indexPlace(grid->transform(), p);
    return static_cast<double>(openvdb::tools::BoxSampler::sample(grid->tree(), place));
  };
}

}  // namespace

std::function<double(const Vec3d&)> gridFunction(const openvdb::GridBase::ConstPtr& grid) {
  if (!grid) throw std::invalid_argument("gridFunction: the grid must not be null");
  if (auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid)) return functionOf(std::move(floats));
  if (auto doubles = openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid)) return functionOf(std::move(doubles));
  throw Error(
      fmt::format("grid \"{}\": values of type {}, expected float or double", grid->getName(), grid->valueType()));
}

}  // namespace pdc
