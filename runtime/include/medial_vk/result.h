// Errors without exceptions: every fallible call of the library returns a Result or a Status. A call whose comment
// states that it throws std::bad_alloc returns its answer directly, and can fail only where the host has no memory.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace medial_vk {

/// The kind of an error. Values from 1000 on are free for a program: its own Extractor may return them through the
/// library.
enum class ErrorCode : int {
  kInternal,     ///< A defect of the library, or a device that was lost.
  kUsage,        ///< An argument that the call does not accept; the message names it.
  kInvalidMesh,  ///< An index out of range, a coordinate that is not finite, no extent, or nothing enclosed.
  kNoDevice,     ///< No usable Vulkan device.
  kOutOfMemory,  ///< Of the host or of the device.
  kInterrupted,  ///< Stopped on request.
};

/// An error code, and one sentence that names the object at fault ("face 17 uses vertex 99 of 98").
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;
};

/// Either a value or an Error. Test ok() before value().
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Error error) : content_(std::move(error)) {}

  bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }

  T& value() & {
    assert(ok());
    return std::get<T>(content_);
  }
  const T& value() const& {
    assert(ok());
    return std::get<T>(content_);
  }
  T&& value() && {
    assert(ok());
    return std::get<T>(std::move(content_));
  }
  const Error& error() const {
    assert(!ok());
    return std::get<Error>(content_);
  }

 private:
  std::variant<T, Error> content_;
};

/// Success, or an Error.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)), ok_(false) {}

  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  const Error& error() const {
    assert(!ok_);
    return error_;
  }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace medial_vk
