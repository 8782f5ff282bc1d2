#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <optional>

namespace pdc::detail {

/// Calls work() so that its parallel loops use this many threads; 0 is all.
template <typename Work>
auto withThreads(int threads, Work&& work) {
  if (threads == 0) return work();
  // More threads than processors have to be allowed first; TBB would warn on standard error otherwise.
  std::optional<tbb::global_control> allow;
  if (threads > tbb::info::default_concurrency())
    allow.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

}  // namespace pdc::detail
