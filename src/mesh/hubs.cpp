#include "mesh/hubs.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <iterator>

#include "mesh/faces.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 4096;

template <typename Visit>
void forEachIn(std::span<const std::uint32_t> numbers, Visit&& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, numbers.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i);
  });
}

/// Lists the hubs, whose vertices are in `of`, and turns these into indices.
void number(std::span<const std::uint32_t> triangles, Hubs& hubs) {
  std::copy_if(hubs.of.begin(), hubs.of.end(), std::back_inserter(hubs.vertices),
               [](std::uint32_t hub) { return hub != kNoHub; });
  sortUnique(hubs.vertices);
  hubs.triangles.resize(hubs.vertices.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::uint32_t& hub = hubs.of[i];
    if (hub == kNoHub) continue;
    const auto place = std::lower_bound(hubs.vertices.begin(), hubs.vertices.end(), hub);
    hub = static_cast<std::uint32_t>(place - hubs.vertices.begin());
    hubs.triangles[hub].push_back(triangles[i]);
  }
}

}  // namespace

Hubs HubSearch::run(std::span<const std::uint32_t> triangles, std::uint32_t besides,
                    const std::function<bool(std::uint32_t, std::uint32_t)>& fits) {
  std::atomic<bool> any = false;
  forEachIn(triangles, [&](std::size_t i) {
    for (const std::uint32_t v : triangle(mMesh, triangles[i]))
      if (v != besides && std::atomic_ref(mCounts[v]).fetch_add(1, std::memory_order_relaxed) + 1 == Hubs::kMany)
        any = true;
  });
  Hubs hubs;
  if (any) {
    hubs.of.resize(triangles.size());
    forEachIn(triangles, [&](std::size_t i) {
      std::uint32_t hub = kNoHub, most = 0;
      for (const std::uint32_t v : triangle(mMesh, triangles[i])) {
        const std::uint32_t count = mCounts[v];
        if (v == besides || count < Hubs::kMany || count < most || (count == most && v > hub)) continue;
        hub = v;
        most = count;
      }
      hubs.of[i] = hub != kNoHub && fits(triangles[i], hub) ? hub : kNoHub;
    });
    number(triangles, hubs);
  }
  if (triangles.size() >= mCounts.size()) {
    std::fill(mCounts.begin(), mCounts.end(), 0U);
  } else {
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t v : triangle(mMesh, t)) mCounts[v] = 0;
  }
  return hubs;
}

}  // namespace pdc::detail
