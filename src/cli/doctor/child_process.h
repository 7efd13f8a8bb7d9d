// Work in a process of its own: drivers run in the process that loads them, and may crash it or never return.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "medial_vk/result.h"
#include "platform/processes.h"

namespace medial_vk::cli {

using platform::ChildEnd;
using platform::ChildOutcome;

/// platform::run_in_child(). Error: kInternal, if the system refuses a process.
inline Result<ChildOutcome> run_in_child(const std::function<std::string()>& work, std::chrono::milliseconds limit) {
  std::string problem;
  ChildOutcome outcome = platform::run_in_child(work, limit, problem);
  if (!problem.empty()) return Error{ErrorCode::kInternal, problem};
  return outcome;
}

}  // namespace medial_vk::cli
