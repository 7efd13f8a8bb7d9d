// Work in a process of its own: drivers run in the process that loads them, and may crash it or never return.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk::cli {

enum class ChildEnd {
  kDone,     ///< `work` returned.
  kCrashed,  ///< A signal ended the process, or it ended by itself before `work` returned.
  kTooLong,  ///< It was ended after the time limit.
};

struct ChildOutcome {
  ChildEnd end = ChildEnd::kCrashed;
  std::string how;       ///< If not done: "crashed: Segmentation fault (signal 11)", "did not end within 60 s".
  std::string result;    ///< What `work` returned.
  std::string messages;  ///< What was written to standard output and standard error meanwhile, shortened if very long.
};

/// Runs `work` in a copy of this process and waits for it, at most for `limit`. Standard input is empty there; nothing
/// that it writes appears, and no core file. It ends with this process. Precondition: no other thread runs, since the
/// copy has this one only; the result is not empty. Error: kInternal, if the system refuses a process.
Result<ChildOutcome> run_in_child(const std::function<std::string()>& work, std::chrono::milliseconds limit);

}  // namespace medial_vk::cli
