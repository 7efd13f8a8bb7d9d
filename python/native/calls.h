// Calls into the library without the interpreter's lock. Long ones run on a thread of their own while the caller's
// waits and handles signals, so that Ctrl-C ends them.
#pragma once

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <exception>
#include <functional>
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
  std::stop_token token() const { return stop_.get_token(); }
  void request_stop() { stop_.request_stop(); }

  /// The calling thread, which holds the interpreter's lock: waits until the work has ended, and handles signals
  /// meanwhile. True: it has ended; false: a signal handler raised an exception, which is set in the interpreter.
  bool wait_or_signal();
  /// Waits without regard to signals, after request_stop().
  void wait();
  /// The working thread.
  void finish();

  /// Passes the progress on, on any thread. An exception of the callback requests a stop and is kept.
  void report(pybind11::handle callback, const char* stage, double done);
  /// Throws the exception of the callback, if there was one.
  void rethrow();

 private:
  bool ended_within(int milliseconds);

  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable condition_;
  bool has_ended_ = false;
  std::optional<pybind11::error_already_set> raised_;  // of the callback; read after the work has ended
};

/// The library's callback for a Python function (stage, done), or none for None. It refers to both arguments.
StageProgress stage_progress(const std::shared_ptr<Call>& call, const pybind11::object& callback);
/// The same for calls of one stage, which gets this name. The name must outlive the callback.
ProgressCallback progress_of_stage(const std::shared_ptr<Call>& call, const pybind11::object& callback,
                                   const char* stage);

/// Runs work(call) -> Result<T> or Status on a thread of its own, and returns its result. After a signal whose handler
/// raises, or an exception of a progress callback, the work is stopped, and that exception is thrown once it has ended.
template <class Work>
auto run(const std::shared_ptr<Call>& call, Work work) {
  std::optional<decltype(work())> result;
  std::exception_ptr thrown;
  std::thread thread([&] {
    try {
      result.emplace(work());
    } catch (...) {
      thrown = std::current_exception();
    }
    call->finish();
  });
  std::optional<pybind11::error_already_set> signal;
  if (!call->wait_or_signal()) {
    signal.emplace();
    call->request_stop();
    call->wait();
  }
  {
    const pybind11::gil_scoped_release released;
    thread.join();
  }
  if (signal) throw pybind11::error_already_set(*signal);
  call->rethrow();
  if (thrown) std::rethrow_exception(thrown);
  return std::move(*result);
}

/// The same for work that cannot be stopped: after a signal the call ends at once, and the work, which must own all
/// that it uses and touch no object of Python, goes on to its end for nothing.
template <class Work>
auto run_or_abandon(Work work) {
  struct Shared {
    Call call;
    std::optional<decltype(work())> result;
    std::exception_ptr thrown;
  };
  const auto shared = std::make_shared<Shared>();
  std::thread([shared, work = std::move(work)]() mutable {
    try {
      shared->result.emplace(work());
    } catch (...) {
      shared->thrown = std::current_exception();
    }
    shared->call.finish();
  }).detach();
  if (!shared->call.wait_or_signal()) throw pybind11::error_already_set();
  if (shared->thrown) std::rethrow_exception(shared->thrown);
  return std::move(*shared->result);
}

/// Runs short work on this thread without the interpreter's lock.
template <class Work>
auto run_here(Work work) {
  const pybind11::gil_scoped_release released;
  return work();
}

}  // namespace medial_vk::python
