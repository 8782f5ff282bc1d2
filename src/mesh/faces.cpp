#include "mesh/faces.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <limits>

#include "pdc/error.h"

namespace pdc::detail {

void checkIndices(const Mesh& mesh) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  constexpr std::size_t kGrain = 4096;
  const std::size_t vertices = mesh.positions.size();
  const std::size_t first = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, faceCount(mesh), kGrain), kNone,
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t found) {
        for (std::size_t i = range.begin(); i != range.end() && found == kNone; ++i)
          for (const std::uint32_t v : face(mesh, i))
            if (v >= vertices) found = i;
        return found;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  if (first == kNone) return;
  const auto named = face(mesh, first);
  throw Error(fmt::format("face {} names vertex {}, but the mesh has {} vertices", first,
                          *std::max_element(named.begin(), named.end()), vertices));
}

}  // namespace pdc::detail
