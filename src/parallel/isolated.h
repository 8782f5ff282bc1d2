#pragma once

#include <tbb/task_arena.h>

#include <utility>

namespace pdc::detail {

/// Calls work(), which may call a user's code. Should that wait for a parallel loop of its own, the waiting thread takes
/// part in that loop only: it does not begin another iteration of the loop that calls this, whose scratch memory is in
/// use.
template <typename Work>
void isolated(Work&& work) {
  tbb::this_task_arena::isolate(std::forward<Work>(work));
}

}  // namespace pdc::detail
