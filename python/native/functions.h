// Functions of Python that threads of the library call.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "native/calls.h"

namespace medial_vk::python {

/// Thrown on a thread of the library where a function of Python has raised an exception, or must not be called any
/// more.
struct FunctionFailed : std::exception {
  const char* what() const noexcept override { return "a function of Python failed"; }
};

/// The functions that one call of the library uses. Between its calls of them, the threads of the library hold nothing
/// of Python, so that they can run on after the caller has gone (Call::wait()).
class Functions {
 public:
  /// The calling thread, which holds the interpreter's lock. Error: kUsage (the process ends).
  Functions(std::vector<pybind11::object> functions, std::shared_ptr<Call> call);
  Functions(const Functions&) = delete;
  Functions& operator=(const Functions&) = delete;
  ~Functions();

  /// Any thread of the library: work(functions) with the interpreter's lock. Throws FunctionFailed if it raises an
  /// exception of Python, which is kept for raise(), after any other call has failed, and when the call was stopped.
  /// Other exceptions are those of the work. When the process ends, the thread does not return, as threads of Python do
  /// then.
  template <class Work>
  void use(const Work& work) {
    const Visit visit(*this);
    try {
      work(functions_);
    } catch (pybind11::error_already_set& error) {
      keep(error);
      throw FunctionFailed();
    }
  }

  /// The calling thread, after FunctionFailed: throws what a function has raised, or that the call was stopped.
  [[noreturn]] void raise();

  /// At the end of the process: no function is called from now on. Waits, for two seconds at most, until those that run
  /// have returned.
  static void end();

 private:
  /// The interpreter's lock, for a thread of the library.
  class Visit {
   public:
    explicit Visit(Functions& of);
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;
    ~Visit();

   private:
    PyGILState_STATE state_;
  };

  void keep(pybind11::error_already_set& error);

  std::vector<pybind11::object> functions_;
  std::shared_ptr<Call> call_;
  std::atomic<bool> has_failed_ = false;
  pybind11::object raised_;  // an exception; written and read with the interpreter's lock
};

}  // namespace medial_vk::python
