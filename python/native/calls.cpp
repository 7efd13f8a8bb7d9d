#include "native/calls.h"

#include <chrono>
#include <cstring>

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

void Call::report(const char* stage, double done) {
  const std::lock_guard lock(mutex_);
  if (!reports_.empty() && std::strcmp(reports_.back().stage, stage) == 0) {
    reports_.back().done = done;
  } else {
    reports_.push_back({stage, done});
  }
}

void Call::finish() {
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  condition_.notify_all();
}

bool Call::ended_within(int milliseconds) {
  return run_here([&] {
    std::unique_lock lock(mutex_);
    return condition_.wait_for(lock, std::chrono::milliseconds(milliseconds), [this] { return has_ended_; });
  });
}

void Call::pass_on(const py::object& progress) {
  std::vector<Progress> reports;
  {
    const std::lock_guard lock(mutex_);
    reports.swap(reports_);
  }
  if (progress.is_none()) return;
  for (const Progress& report : reports) progress(report.stage, report.done);
}

void Call::abandon() {
  stop_.request_stop();
  if (is_stoppable_ && !ended_within(kMillisecondsToStop)) {
    is_counted_ = true;
    abandoned().add(1);
  }
}

void Call::wait(const py::object& progress) {
  try {
    while (!ended_within(kMillisecondsBetweenSignals)) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      pass_on(progress);
    }
    pass_on(progress);
  } catch (const py::error_already_set&) {
    abandon();
    throw;
  }
}

void Call::wait_for_abandoned() {
  run_here([] {
    Abandoned& all = abandoned();
    std::unique_lock lock(all.mutex);
    return all.condition.wait_for(lock, std::chrono::seconds(2), [&all] { return all.count == 0; });
  });
}

CallWithProgress::CallWithProgress(py::object function) : progress(std::move(function)) {
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) fail_usage("`progress` is not callable");
}

StageProgress CallWithProgress::stages() const {
  if (progress.is_none()) return {};
  return [to = call](const char* stage, double done) { to->report(stage, done); };
}

ProgressCallback CallWithProgress::of_stage(const char* stage) const {
  if (progress.is_none()) return {};
  return [to = call, stage](double done) { to->report(stage, done); };
}

}  // namespace medial_vk::python
