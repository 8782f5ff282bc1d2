#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "pdc/monitor.h"

namespace pdc::python {

namespace py = pybind11;

using Work = std::function<void(const Monitor&)>;

/// Calls work(monitor) on a thread of its own, with the interpreter's lock released, and waits for it. Meanwhile the
/// calling thread, every hundredth of a second, lets Python look at signals and calls `progress(stage, share)`,
/// unless that is None; where either raises, the work is stopped first. Called with the interpreter's lock held.
/// \throws what either raises, then what the work throws; Error in a process that was forked after such work.
void runPolitely(const py::object& progress, const Work& work);

/// The same for work that has a result.
template <typename Make>
auto makePolitely(const py::object& progress, const Make& make) {
  std::optional<decltype(make(std::declval<const Monitor&>()))> result;
  runPolitely(progress, [&](const Monitor& monitor) { result.emplace(make(monitor)); });
  return std::move(*result);
}

}  // namespace pdc::python
