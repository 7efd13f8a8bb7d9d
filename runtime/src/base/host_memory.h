// Exhausted host memory is reported at the library's interface as an error, not as an exception.
#pragma once

#include <new>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk {

/// The result of `work()`, or kOutOfMemory if it throws std::bad_alloc. `doing` completes "out of memory while".
template <class Work>
auto catch_out_of_memory(const char* doing, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, std::string("out of memory while ") + doing};
  }
}

}  // namespace medial_vk
