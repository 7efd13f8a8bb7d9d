// Errors of the library as exceptions of medial_vk.errors.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

#include "medial_vk/result.h"

namespace medial_vk::python {

/// An error of the library on its way to Python, where its class follows from its code.
class LibraryError : public std::exception {
 public:
  explicit LibraryError(Error error) : error_(std::move(error)) {}

  const Error& error() const { return error_; }
  const char* what() const noexcept override { return error_.message.c_str(); }

 private:
  Error error_;
};

/// The value, or an exception.
template <class T>
T value_of(Result<T> result) {
  if (!result) throw LibraryError(result.error());
  return std::move(result).value();
}

inline void require(const Status& status) {
  if (!status) throw LibraryError(status.error());
}

[[noreturn]] inline void fail_usage(std::string message) {
  throw LibraryError({ErrorCode::kUsage, std::move(message)});
}

/// Lets Python see LibraryError and std::bad_alloc as the classes of medial_vk.errors.
void register_errors();

}  // namespace medial_vk::python
