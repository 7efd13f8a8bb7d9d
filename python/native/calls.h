// Calls into the library without the interpreter's lock. Long ones run on a thread of their own while the caller's
// waits, handles signals, so that Ctrl-C ends them, and calls progress functions. The threads of the library never
// touch Python.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "medial_vk/progress.h"
#include "native/errors.h"

namespace medial_vk::python {

/// One long call, as its threads see it.
class Call {
 public:
  ~Call();

  /// For the library: a request to stop the work.
  std::stop_token token() {
    is_stoppable_ = true;
    return stop_.get_token();
  }
  /// For the library, on any thread: the progress, which wait() passes on. Within a stage the last one counts.
  void report(const char* stage, double done);
  /// The working thread.
  void finish();

  /// The calling thread, which holds the interpreter's lock: waits until the work has ended, handles signals, and calls
  /// `progress`, a function of the stage and its share, or None. If a handler or the function raises, the work is
  /// stopped, and the exception thrown as soon as the work has ended, or after some hundredths of a second: the work is
  /// then abandoned, and ends by itself.
  void wait(const pybind11::object& progress);

  /// At the end of the process: waits, for two seconds at most, until abandoned work that can be stopped has ended, for
  /// it may use a device whose driver is about to be unloaded.
  static void wait_for_abandoned();

 private:
  struct Progress {
    const char* stage;
    double done;
  };

  bool ended_within(int milliseconds);
  void pass_on(const pybind11::object& progress);
  void abandon();

  std::stop_source stop_;
  std::atomic<bool> is_stoppable_ = false;
  std::mutex mutex_;
  std::condition_variable condition_;
  bool has_ended_ = false;
  bool is_counted_ = false;  // among the abandoned ones
  std::vector<Progress> reports_;
};

/// A call with the function that wants its progress, which is callable or None. Error: kUsage.
struct CallWithProgress {
  explicit CallWithProgress(pybind11::object function);

  /// For the library; empty without a function.
  StageProgress stages() const;
  /// The same for calls of one stage, which gets this name. The name must outlive the callback.
  ProgressCallback of_stage(const char* stage) const;

  std::shared_ptr<Call> call = std::make_shared<Call>();
  pybind11::object progress;
};

/// Runs work() on a thread of its own, and returns its result (a Result or a Status of the library). The work must own
/// all that it uses, and touch no object of Python, as it may be abandoned: Call::wait().
template <class Work>
auto run(const std::shared_ptr<Call>& call, Work work, const pybind11::object& progress = pybind11::none()) {
  struct Shared {
    std::shared_ptr<Call> call;
    std::optional<decltype(work())> result;
    std::exception_ptr thrown;
  };
  const auto shared = std::make_shared<Shared>();
  shared->call = call;
  std::thread([shared, work = std::move(work)]() mutable {
    try {
      shared->result.emplace(work());
    } catch (...) {
      shared->thrown = std::current_exception();
    }
    shared->call->finish();
  }).detach();
  call->wait(progress);
  if (shared->thrown) std::rethrow_exception(shared->thrown);
  return std::move(*shared->result);
}

/// The same for work without progress that cannot be stopped.
template <class Work>
auto run(Work work) {
  return run(std::make_shared<Call>(), std::move(work));
}

/// Runs short work on this thread: one of its own takes some fifty microseconds, and no signal waits long.
template <class Work>
auto run_here(Work work) {
  // Not by an object whose destructor takes the lock: where the interpreter has ended meanwhile, that ends the thread,
  // and nothing may leave a destructor.
  PyThreadState* const state = PyEval_SaveThread();
  try {
    auto result = work();
    PyEval_RestoreThread(state);
    return result;
  } catch (const std::exception&) {
    PyEval_RestoreThread(state);
    throw;
  }
}

/// One of both; short work reports no progress.
template <class Work>
auto run_unless_short(bool is_short, const std::shared_ptr<Call>& call, Work work,
                      const pybind11::object& progress = pybind11::none()) {
  return is_short ? run_here(std::move(work)) : run(call, std::move(work), progress);
}

}  // namespace medial_vk::python
