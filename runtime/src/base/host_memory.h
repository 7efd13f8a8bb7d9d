// The conversion of exceptions of exhausted host memory to errors, at the interface of the library.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk {

/// kOutOfMemory with the message "out of memory while `doing`" and, if given, "; `advice`", or a shorter one if there
/// is no memory for it.
inline Error out_of_memory(const char* doing, const char* advice = "") noexcept {
  Error error;
  error.code = ErrorCode::kOutOfMemory;
  try {
    error.message = std::string("out of memory while ") + doing;
    if (*advice != '\0') error.message += std::string("; ") + advice;
  } catch (const std::bad_alloc&) {
    error.message = "out of memory";  // short enough for a string without memory of its own
  }
  return error;
}

/// The result of `work()`, or kOutOfMemory if it throws std::bad_alloc, or std::length_error: more elements than a
/// container can hold. `doing` completes "out of memory while".
template <class Work>
auto catch_out_of_memory(const char* doing, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return out_of_memory(doing);
  } catch (const std::length_error&) {
    return out_of_memory(doing);
  }
}

}  // namespace medial_vk
