#include "polite_run.h"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "pdc/error.h"

namespace pdc::python {
namespace {

constexpr std::chrono::milliseconds kPoll{10};

std::atomic<bool> gHasRun = false;
std::atomic<bool> gForkedAfterwards = false;

/// The threads of TBB do not live on in a forked child, which would wait for them.
void refuseAfterFork() {
  static const int registered =
      ::pthread_atfork(nullptr, nullptr, [] { gForkedAfterwards = gForkedAfterwards || gHasRun; });
  static_cast<void>(registered);
  if (gForkedAfterwards)
    throw Error(
        "this process was forked after pdc had worked, and pdc's threads are not in it: fork before the first call, or "
        "start processes with multiprocessing.get_context('spawn')");
  gHasRun = true;
}

/// What the working thread tells the calling one.
class Watch {
 public:
  void note(const char* stage, double share) {
    const std::lock_guard lock(mMutex);
    mStage = stage;
    mShare = share;
    mNews = true;
  }
  void finish() {
    const std::lock_guard lock(mMutex);
    mDone = true;
    mFinished.notify_all();
  }
  /// \returns whether the work is done.
  [[nodiscard]] bool wait() {
    std::unique_lock lock(mMutex);
    return mFinished.wait_for(lock, kPoll, [this] { return mDone; });
  }
  /// Calls progress() with what is new.
  void tell(const py::object& progress) {
    std::string stage;
    double share = 0;
    {
      const std::lock_guard lock(mMutex);
      if (!mNews) return;
      mNews = false;
      stage = mStage;
      share = mShare;
    }
    progress(stage, share);
  }

 private:
  std::mutex mMutex;
  std::condition_variable mFinished;
  std::string mStage;
  double mShare = 0;
  bool mNews = false, mDone = false;
};

/// Threads that take work and wait for more. TBB keeps something of each thread in which a parallel loop ended by an
/// exception, so that a new thread for each call would make a process grow.
class Workers {
 public:
  /// Those of the process. They live as long as it does, and so does what they wait for.
  static Workers& all() {
    static auto* const workers = new Workers;
    return *workers;
  }
  void start(std::function<void()> job) {
    const std::lock_guard lock(mMutex);
    if (mIdle <= mJobs.size()) std::thread([this] { takeJobs(); }).detach();
    mJobs.push_back(std::move(job));
    mWake.notify_one();
  }

 private:
  [[noreturn]] void takeJobs() {
    std::unique_lock lock(mMutex);
    for (;;) {
      ++mIdle;
      mWake.wait(lock, [this] { return !mJobs.empty(); });
      --mIdle;
      std::function<void()> job = std::move(mJobs.front());
      mJobs.pop_front();
      lock.unlock();
      job();
      job = nullptr;
      lock.lock();
    }
  }

  std::mutex mMutex;
  std::condition_variable mWake;
  std::deque<std::function<void()>> mJobs;
  std::size_t mIdle = 0;
};

}  // namespace

void runPolitely(const py::object& progress, const Work& work) {
  refuseAfterFork();
  const auto watch = std::make_shared<Watch>();
  std::atomic<bool> stop = false;
  Monitor monitor{.progress = {}, .stop = &stop};
  if (!progress.is_none()) monitor.progress = [&watch](const char* stage, double share) { watch->note(stage, share); };

  std::exception_ptr failure, raised;
  const auto listen = [&] {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none()) watch->tell(progress);
    } catch (const py::error_already_set&) {
      raised = std::current_exception();
      stop = true;
    }
  };
  {
    const py::gil_scoped_release release;
    // The last that a worker touches is the watch, of which it has its own share.
    Workers::all().start([&monitor, &work, &failure, watch] {
      {
        const ThreadState state;
        try {
          work(monitor);
        } catch (...) {
          failure = std::current_exception();
        }
      }
      watch->finish();
    });
    while (!watch->wait()) {
      const py::gil_scoped_acquire acquire;
      if (!raised) listen();
    }
  }
  if (!raised && !failure) listen();
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace pdc::python
