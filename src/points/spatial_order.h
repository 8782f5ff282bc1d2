#pragma once

#include <tbb/parallel_sort.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "parallel/for_each_in_parallel.h"
#include "pdc/math/vec3.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {

/// Where a point is along the curve of Morton (1966) in a box.
struct PointCode {
  std::uint64_t code;
  std::uint32_t index;
};

/// In the order of the points. The box is that of the points, which are finite.
[[nodiscard]] Buffer<PointCode> pointCodes(std::span<const Vec3d> points);

/// The indices of points in the order of a curve that fills space, so that points near each other come near each other;
/// within a code they come by x, y and z. Which point is where does not depend on the order that they are given in, but
/// for equal ones, which come in the order of before(i, j).
template <typename Before>
[[nodiscard]] Buffer<std::uint32_t> spatialOrder(std::span<const Vec3d> points, const Before& before) {
  Buffer<PointCode> codes = pointCodes(points);
  tbb::parallel_sort(codes.begin(), codes.end(), [&](const PointCode& a, const PointCode& b) {
    if (a.code != b.code) return a.code < b.code;
    const Vec3d &p = points[a.index], &q = points[b.index];
    if (p == q) return before(a.index, b.index);
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  });
  Buffer<std::uint32_t> order(codes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = codes[i].index;
  return order;
}

/// The elements of a list in another order.
template <typename T>
[[nodiscard]] Buffer<T> inOrder(const Buffer<T>& list, std::span<const std::uint32_t> order) {
  if (list.empty()) return {};
  Buffer<T> result(order.size());
  forEachInParallel(order.size(), 4096, [&](std::uint32_t i) { result[i] = list[order[i]]; });
  return result;
}

}  // namespace pdc::detail
