// Errors of the tool alone, beside those of the library (medial_vk/result.h), in the same Result and Status.
#pragma once

#include "medial_vk/result.h"

namespace medial_vk {

inline constexpr ErrorCode kCannotWrite{1000};  ///< A file that cannot be written.
inline constexpr ErrorCode kCheckFailed{1001};  ///< Results that did not pass a check.
inline constexpr ErrorCode kWallTooThin{1002};  ///< A wall or a gap that is thinner than demanded, or may be.
inline constexpr ErrorCode kSomeFailed{1003};   ///< Some meshes of many that have no results.
inline constexpr ErrorCode kDiskFails{1004};    ///< A file that cannot be written where no other one can be, either.

}  // namespace medial_vk
