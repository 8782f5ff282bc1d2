#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>

namespace pdc::detail {

/// Calls visit(i) for i from 0 to n - 1, in parallel, at least `grain` of them on one thread; n is below 2^32.
template <typename Visit>
void forEachInParallel(std::size_t n, std::size_t grain, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& r) {
    for (std::size_t i = r.begin(); i < r.end(); ++i) visit(static_cast<std::uint32_t>(i));
  });
}

}  // namespace pdc::detail
