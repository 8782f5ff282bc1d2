#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <memory>

#include "math/lane_loops.h"
#include "pdc/monitor.h"
#include "sample/dense/key_ranges.h"
#include "sample/dense/stored_scalars.h"
#include "sample/dense/volume_sampler.h"
#include "sample/meaning/value_range.h"

namespace pdc::detail {

/// The reading of a mask: numbers above zero have data.
[[nodiscard]] std::unique_ptr<const VolumeSampler> makeMaskSampler(const VolumeView& mask);

/// Looks at all values, in parallel and in the order in which they lie in memory: calls visit(part, raw, count) for
/// runs of them. \param mask null, or a mask: values without data are left out. \returns the sum (+=) of all parts, in
/// no order, so that it must not matter.
template <typename Scalar, typename Part, typename Visit>
Part scanVolume(const VolumeView& view, const VolumeSampler* mask, const Monitor& monitor, const Visit& visit) {
  using Raw = typename Scalar::Raw;
  const Axis run = runAxis(view), u = nextAxis(run), v = previousAxis(run);
  const auto distance = [&](Axis a) { return view.stride[a] < 0 ? -view.stride[a] : view.stride[a]; };
  const Axis inner = distance(u) < distance(v) ? u : v, outer = inner == u ? v : u;
  tbb::enumerable_thread_specific<Part> parts;
  const auto readLine = [&](Coord first, Part& part) {
    const StoredLine<Raw> line{
        view.data + (view.stride[0] * first[0] + view.stride[1] * first[1] + view.stride[2] * first[2]),
        view.stride[run], view.swapped};
    for (std::int64_t i = 0; i < view.size[run]; i += kMostRun) {
      const int count = static_cast<int>(std::min<std::int64_t>(kMostRun, view.size[run] - i));
      Raw raw[kMostRun];
      StoredLine<Raw>{line.from + i * line.step, line.step, line.swapped}.copy(count, raw);
      int kept = count;
      if (mask != nullptr) {
        std::uint64_t bits[kMostRun / 64];
        first[run] = static_cast<std::int32_t>(i);
        mask->insideBits(first, run, count, bits);
        kept = 0;
        for (int k = 0; k < count; ++k)
          if ((bits[k / 64] >> k % 64 & 1) != 0) raw[kept++] = raw[k];
      }
      visit(part, raw, kept);
    }
  };
  const std::int64_t lines = view.size[outer] * view.size[inner];
  const std::int64_t grain = std::max<std::int64_t>(1, 65536 / view.size[run]);
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, lines, grain), [&](const auto& range) {
    monitor.throwIfStopped();
    Part& part = parts.local();
    withSimd(bestSimdLevel(), [&] {
      for (std::int64_t l = range.begin(); l != range.end(); ++l) {
        Coord first{};
        first[outer] = static_cast<std::int32_t>(l / view.size[inner]);
        first[inner] = static_cast<std::int32_t>(l % view.size[inner]);
        readLine(first, part);
      }
    });
  });
  Part sum{};
  for (const Part& part : parts) sum += part;
  return sum;
}

/// The range of what finite values mean. \param mask null, or a mask. \throws Cancelled.
[[nodiscard]] ValueRange valueRange(const VolumeView& view, const VolumeView* mask, const Monitor& monitor = {});

/// The number of values that are negative or not finite.
[[nodiscard]] std::size_t countRefused(const VolumeView& view);

/// Looks for values that are not finite, where the mask, if there is one, has data. \throws Error that names the first
/// of them, if there are any.
void requireFiniteValues(const VolumeSampler& values, const VolumeView* mask);

}  // namespace pdc::detail
