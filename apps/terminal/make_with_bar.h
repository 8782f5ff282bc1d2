#pragma once

#include <fmt/format.h>

#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"

namespace pdc {

/// Calls make(monitor) for a request that has `input`, `quiet` and `threads`: with a bar, unless quiet, on as many
/// threads as asked for, and stopped by an interrupt. \returns the mesh made. \throws Error that begins with the
/// input's path; Cancelled.
template <typename Request, typename Make>
Mesh makeWithBar(const Request& request, const Make& make) {
  try {
    ProgressBar bar(!request.quiet);
    const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
    const Monitor monitor{.progress = show, .stop = &interruptFlag()};
    return detail::withThreads(request.threads.value_or(0), [&] { return make(monitor); });
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", request.input.string(), error.what()));
  }
}

}  // namespace pdc
