#include "native/calls.h"

#include <chrono>

namespace medial_vk::python {

namespace py = pybind11;

bool Call::ended_within(int milliseconds) {
  const py::gil_scoped_release released;
  std::unique_lock lock(mutex_);
  return condition_.wait_for(lock, std::chrono::milliseconds(milliseconds), [this] { return has_ended_; });
}

bool Call::wait_or_signal() {
  while (!ended_within(20)) {
    if (PyErr_CheckSignals() != 0) return false;
  }
  return true;
}

void Call::wait() {
  const py::gil_scoped_release released;
  std::unique_lock lock(mutex_);
  condition_.wait(lock, [this] { return has_ended_; });
}

void Call::finish() {
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  condition_.notify_all();  // under the lock: the waiting thread may destroy this object as soon as it has it
}

void Call::report(py::handle callback, const char* stage, double done) {
  if (stop_.stop_requested()) return;
  const py::gil_scoped_acquire locked;
  try {
    callback(stage, done);
  } catch (py::error_already_set& error) {
    if (!raised_) raised_.emplace(std::move(error));
    stop_.request_stop();
  }
}

void Call::rethrow() {
  if (!raised_) return;
  const py::error_already_set error = std::move(*raised_);
  raised_.reset();
  throw py::error_already_set(error);
}

StageProgress stage_progress(const std::shared_ptr<Call>& call, const py::object& callback) {
  if (callback.is_none()) return {};
  if (PyCallable_Check(callback.ptr()) == 0) {
    fail_usage("`progress` is not callable");
  }
  // A pointer without ownership: it is copied on threads that do not hold the interpreter's lock. The caller holds the
  // object until the call ends.
  const py::handle function = callback;
  return [call, function](const char* stage, double done) { call->report(function, stage, done); };
}

ProgressCallback progress_of_stage(const std::shared_ptr<Call>& call, const py::object& callback, const char* stage) {
  const StageProgress progress = stage_progress(call, callback);
  if (!progress) return {};
  return [progress, stage](double done) { progress(stage, done); };
}

}  // namespace medial_vk::python
