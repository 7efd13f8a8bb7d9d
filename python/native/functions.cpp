#include "native/functions.h"

#include <chrono>
#include <condition_variable>
#include <thread>

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// The threads of the library that are in Python, or wait for its lock.
struct Visitors {
  std::mutex mutex;
  std::condition_variable condition;
  int count = 0;
  bool has_ended = false;

  bool enter() {
    const std::lock_guard lock(mutex);
    if (has_ended) return false;
    ++count;
    return true;
  }

  void leave() {
    const std::lock_guard lock(mutex);
    --count;
    condition.notify_all();
  }
};

/// Never destroyed: threads may end after the objects of the process.
Visitors& visitors() {
  static auto* const all = new Visitors;
  return *all;
}

[[noreturn]] void sleep_until_the_process_has_ended() {
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace

Functions::Functions(std::vector<py::object> functions, std::shared_ptr<Call> call)
    : functions_(std::move(functions)), call_(std::move(call)) {
  if (!visitors().enter()) fail_usage("the process ends, and calls no functions any more");
  visitors().leave();
}

/// On any thread. What is left when the process ends stays.
Functions::~Functions() {
  if (visitors().enter()) {
    const PyGILState_STATE state = PyGILState_Ensure();
    functions_.clear();
    raised_ = py::object();
    PyGILState_Release(state);
    visitors().leave();
  } else {
    for (py::object& function : functions_) function.release();
    raised_.release();
  }
}

Functions::Visit::Visit(Functions& of) {
  if (of.has_failed_ || of.call_->token().stop_requested()) throw FunctionFailed();
  if (!visitors().enter()) sleep_until_the_process_has_ended();
  state_ = PyGILState_Ensure();
}

Functions::Visit::~Visit() {
  PyGILState_Release(state_);
  visitors().leave();
}

void Functions::keep(py::error_already_set& error) {
  if (has_failed_.exchange(true)) return;
  error.restore();
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  if (trace != nullptr) PyException_SetTraceback(value, trace);
  raised_ = py::reinterpret_steal<py::object>(value);
  Py_XDECREF(type);
  Py_XDECREF(trace);
}

void Functions::raise() {
  if (!raised_) throw LibraryError({ErrorCode::kInterrupted, "stopped"});
  PyErr_SetObject(py::type::handle_of(raised_).ptr(), raised_.ptr());
  throw py::error_already_set();
}

void Functions::end() {
  run_here([] {
    Visitors& all = visitors();
    std::unique_lock lock(all.mutex);
    all.has_ended = true;
    return all.condition.wait_for(lock, std::chrono::seconds(2), [&all] { return all.count == 0; });
  });
}

}  // namespace medial_vk::python
