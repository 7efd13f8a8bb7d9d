#include "native/calls.h"

#include <chrono>

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// A signal is handled within the first of these times, and the caller continues within both.
constexpr int kMillisecondsBetweenSignals = 10;
constexpr int kMillisecondsToStop = 60;

/// The number of abandoned calls that can be stopped and have not ended.
struct Abandoned {
  std::mutex mutex;
  std::condition_variable condition;
  int count = 0;

  void add(int change) {
    const std::lock_guard lock(mutex);
    count += change;
    condition.notify_all();
  }
};

/// Never destroyed: threads may end after the objects of the process.
Abandoned& abandoned() {
  static auto* const all = new Abandoned;
  return *all;
}

}  // namespace

Call::~Call() {
  if (is_counted_) abandoned().add(-1);
}

bool Call::ended_within(int milliseconds) {
  const py::gil_scoped_release released;
  std::unique_lock lock(mutex_);
  return condition_.wait_for(lock, std::chrono::milliseconds(milliseconds), [this] { return has_ended_; });
}

void Call::wait() {
  while (!ended_within(kMillisecondsBetweenSignals)) {
    if (PyErr_CheckSignals() == 0) continue;
    const py::error_already_set error;
    stop_.request_stop();
    is_abandoned_ = true;
    raised_.reset();
    if (is_stoppable_ && !ended_within(kMillisecondsToStop)) {
      is_counted_ = true;
      abandoned().add(1);
    }
    throw py::error_already_set(error);
  }
}

void Call::finish() {
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  condition_.notify_all();
}

void Call::report(py::handle callback, const char* stage, double done) {
  if (stop_.stop_requested()) return;
  const py::gil_scoped_acquire locked;
  if (is_abandoned_) return;  // the callback may be gone
  try {
    callback(stage, done);
  } catch (py::error_already_set& error) {
    if (!raised_) raised_.emplace(error);
    stop_.request_stop();
  }
}

void Call::rethrow() {
  if (!raised_) return;
  const py::error_already_set error = std::move(*raised_);
  raised_.reset();
  throw py::error_already_set(error);
}

void Call::wait_for_abandoned() {
  const py::gil_scoped_release released;
  Abandoned& all = abandoned();
  std::unique_lock lock(all.mutex);
  all.condition.wait_for(lock, std::chrono::seconds(2), [&all] { return all.count == 0; });
}

StageProgress stage_progress(const std::shared_ptr<Call>& call, const py::object& callback) {
  if (callback.is_none()) return {};
  if (PyCallable_Check(callback.ptr()) == 0) fail_usage("`progress` is not callable");
  const py::handle function = callback;
  return [call, function](const char* stage, double done) { call->report(function, stage, done); };
}

ProgressCallback progress_of_stage(const std::shared_ptr<Call>& call, const py::object& callback, const char* stage) {
  const StageProgress progress = stage_progress(call, callback);
  if (!progress) return {};
  return [progress, stage](double done) { progress(stage, done); };
}

}  // namespace medial_vk::python
