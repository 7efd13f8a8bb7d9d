// Calls into the library without the interpreter's lock. Long ones run on a thread of their own while the caller's
// waits and handles signals, so that Ctrl-C ends them.
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

#include "medial_vk/progress.h"
#include "native/errors.h"

namespace medial_vk::python {

/// One long call, as its two threads see it.
class Call {
 public:
  ~Call();

  /// For the library: a request to stop the work.
  std::stop_token token() {
    is_stoppable_ = true;
    return stop_.get_token();
  }

  /// The calling thread, which holds the interpreter's lock: waits until the work has ended, and handles signals
  /// meanwhile. If a handler raises, the work is stopped, and the exception thrown as soon as the work has ended, or
  /// after some hundredths of a second: the work is then abandoned, and ends by itself.
  void wait();
  /// The working thread.
  void finish();

  /// Passes the progress on, on any thread. An exception of the callback requests a stop and is kept.
  void report(pybind11::handle callback, const char* stage, double done);
  /// Throws the exception of the callback, if there was one.
  void rethrow();

  /// At the end of the process: waits, for two seconds at most, until abandoned work that can be stopped has ended, for
  /// it may use a device whose driver is about to be unloaded.
  static void wait_for_abandoned();

 private:
  bool ended_within(int milliseconds);

  std::stop_source stop_;
  std::atomic<bool> is_stoppable_ = false;
  std::mutex mutex_;
  std::condition_variable condition_;
  bool has_ended_ = false;
  bool is_abandoned_ = false;                          // under the interpreter's lock
  bool is_counted_ = false;                            // among the abandoned ones
  std::optional<pybind11::error_already_set> raised_;  // of the callback; under the interpreter's lock
};

/// The library's callback for a Python function (stage, done), or none for None. The function must live until the call
/// ends. The callback is copied on threads that do not hold the interpreter's lock, and owns nothing of Python.
StageProgress stage_progress(const std::shared_ptr<Call>& call, const pybind11::object& callback);
/// The same for calls of one stage, which gets this name. The name must outlive the callback.
ProgressCallback progress_of_stage(const std::shared_ptr<Call>& call, const pybind11::object& callback,
                                   const char* stage);

/// Runs work() on a thread of its own, and returns its result (a Result or a Status of the library). The work must own
/// all that it uses, and touch no object of Python, as it may be abandoned: Call::wait().
template <class Work>
auto run(const std::shared_ptr<Call>& call, Work work) {
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
  call->wait();
  call->rethrow();
  if (shared->thrown) std::rethrow_exception(shared->thrown);
  return std::move(*shared->result);
}

/// Runs short work on this thread: one of its own takes some fifty microseconds, and no signal waits long.
template <class Work>
auto run_here(Work work) {
  const pybind11::gil_scoped_release released;
  return work();
}

/// One of both. Without a call, the work reports no progress and cannot be stopped.
template <class Work>
auto run_unless_short(bool is_short, const std::shared_ptr<Call>& call, Work work) {
  if (!is_short) return run(call, std::move(work));
  auto result = run_here(std::move(work));
  call->rethrow();
  return result;
}

}  // namespace medial_vk::python
