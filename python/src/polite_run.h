#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "parallel/with_threads.h"
#include "pdc/monitor.h"

namespace pdc::python {

namespace py = pybind11;

/// What Python holds of a thread that it did not start, for as long as this lives. Without it each call into Python
/// makes and unmakes that, which maps and unmaps memory and makes all processors wait. Made and ended on that thread,
/// without the interpreter's lock.
class ThreadState {
 public:
  ThreadState() : mHandle(PyGILState_Ensure()), mState(PyEval_SaveThread()) {}
  ThreadState(const ThreadState&) = delete;
  ThreadState& operator=(const ThreadState&) = delete;
  ~ThreadState() {
    PyEval_RestoreThread(mState);
    PyGILState_Release(mHandle);
  }

 private:
  PyGILState_STATE mHandle;
  PyThreadState* mState;
};

using Work = std::function<void(const Monitor&)>;

/// Calls work(monitor) on a thread that is not Python's, with the interpreter's lock released, and waits for it.
/// Meanwhile the calling thread, every hundredth of a second, lets Python look at signals and calls
/// `progress(stage, share)`, unless that is None; where either raises, the work is stopped first. Called with the
/// interpreter's lock held. \throws what either raises, then what the work throws; Error in a process that was forked
/// after such work.
void runPolitely(const py::object& progress, const Work& work);

/// The same for work that has a result.
template <typename Make>
auto makePolitely(const py::object& progress, const Make& make) {
  std::optional<decltype(make(std::declval<const Monitor&>()))> result;
  runPolitely(progress, [&](const Monitor& monitor) { result.emplace(make(monitor)); });
  return std::move(*result);
}

/// The same on so many threads; 0 is all.
template <typename Make>
auto makePolitely(const py::object& progress, int threads, const Make& make) {
  return makePolitely(
      progress, [&](const Monitor& monitor) { return detail::withThreads(threads, [&] { return make(monitor); }); });
}

}  // namespace pdc::python
