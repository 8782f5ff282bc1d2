#include "pdc/sample/vdb/grid_attribute.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "pdc/error.h"
#include "sample/meaning/contourable_grids.h"
#include "sample/vdb/index_place.h"

namespace pdc {
namespace {

template <typename Value>
constexpr int kComponents = openvdb::VecTraits<Value>::IsVec ? 3 : 1;

template <typename Value>
using Element = typename openvdb::VecTraits<Value>::ElementType;

/// The type of a property that holds all values of a grid's, or nearly: no .ply file has whole numbers of 64 bits.
template <typename Value>
using Number =
    std::conditional_t<std::is_same_v<Element<Value>, bool>, std::uint8_t,
                       std::conditional_t<std::is_same_v<Element<Value>, std::int64_t>, double, Element<Value>>>;

template <typename Value>
Element<Value> component(const Value& value, int k) {
  if constexpr (openvdb::VecTraits<Value>::IsVec)
    return value[k];
  else
    return k == 0 ? value : Value{};
}

/// Calls take(vertex, value) for each vertex, in parallel.
template <typename Sampler, typename Grid, typename Take>
void sampleAt(const Grid& grid, const Mesh& mesh, const Monitor& monitor, const Take& take) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.positions.size(), 4096), [&](const auto& r) {
    if (monitor.stopped()) return;
    const auto accessor = grid.getConstUnsafeAccessor();
    for (std::size_t v = r.begin(); v < r.end(); ++v) {
      const Vec3d world = mesh.origin + vecCast<double>(mesh.positions[v]);
      take(v, Sampler::sample(accessor, detail::indexPlace(grid.transform(), world)));
    }
  });
  monitor.throwIfStopped();
}

template <typename Grid, typename Take>
void sampleByType(const Grid& grid, const Mesh& mesh, const Monitor& monitor, const Take& take) {
  using Value = typename Grid::ValueType;
  if constexpr (!std::is_floating_point_v<Element<Value>>) {
    sampleAt<openvdb::tools::PointSampler>(grid, mesh, monitor, take);
  } else if constexpr (kComponents<Value> == 1) {
    sampleAt<openvdb::tools::BoxSampler>(grid, mesh, monitor, take);
  } else if (grid.getGridClass() == openvdb::GRID_STAGGERED) {
    sampleAt<openvdb::tools::StaggeredBoxSampler>(grid, mesh, monitor, take);
  } else {
    sampleAt<openvdb::tools::BoxSampler>(grid, mesh, monitor, take);
  }
}

/// The byte of a colour's component.
std::uint8_t colourByte(double share) {
  constexpr double kMost = 255;
  return share > 0 ? static_cast<std::uint8_t>(std::lround(std::min(share, 1.0) * kMost)) : std::uint8_t{0};
}

template <typename Grid>
std::vector<VertexProperty> colours(const Grid& grid, const Mesh& mesh, const Monitor& monitor) {
  std::array<Buffer<std::uint8_t>, 3> bytes;
  for (auto& buffer : bytes) buffer.resize(mesh.positions.size());
  sampleByType(grid, mesh, monitor, [&](std::size_t v, const auto& value) {
    for (int k = 0; k < 3; ++k) bytes[k][v] = colourByte(static_cast<double>(value[k]));
  });
  return {{"red", 1, std::move(bytes[0])}, {"green", 1, std::move(bytes[1])}, {"blue", 1, std::move(bytes[2])}};
}

template <typename Grid>
std::vector<VertexProperty> values(const Grid& grid, const std::string& name, const Mesh& mesh,
                                   const Monitor& monitor) {
  using Value = typename Grid::ValueType;
  constexpr int kSize = kComponents<Value>;
  Buffer<Number<Value>> numbers(kSize * mesh.positions.size());
  sampleByType(grid, mesh, monitor, [&](std::size_t v, const Value& value) {
    for (int k = 0; k < kSize; ++k) numbers[kSize * v + k] = static_cast<Number<Value>>(component(value, k));
  });
  return {{name, kSize, std::move(numbers)}};
}

}  // namespace

std::vector<VertexProperty> gridAttribute(const openvdb::GridBase& grid, const std::string& name, const Mesh& mesh,
                                          const Monitor& monitor) {
  if (name.empty()) throw std::invalid_argument("gridAttribute: the name is empty");
  std::string plain = name;
  const auto isBlank = [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '\x7f'; };
  std::replace_if(plain.begin(), plain.end(), isBlank, '_');
  std::vector<VertexProperty> properties;
  const bool known = grid.apply<detail::SampledGrids>([&]<typename Grid>(const Grid& typed) {
    using Value = typename Grid::ValueType;
    if constexpr (kComponents<Value> == 3 && std::is_floating_point_v<Element<Value>>) {
      if (plain == "Cd") {
        properties = colours(typed, mesh, monitor);
        return;
      }
    }
    properties = values(typed, plain, mesh, monitor);
  });
  if (!known)
    throw Error(fmt::format("grid \"{}\" of type {} cannot be sampled; {} can", name, grid.valueType(),
                            detail::gridTypeNames<detail::SampledGrids>()));
  return properties;
}

}  // namespace pdc
