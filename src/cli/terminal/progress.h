// A progress line on the terminal.
#pragma once

#include <chrono>
#include <string>

namespace medial_vk::cli {

/// "extract    [============            ]  50 %, 12 s left". `done` is 0 to 1; `elapsed` is in seconds since the stage
/// began; the remaining time is left out until it can be estimated.
std::string progress_line(const std::string& stage, double done, double elapsed);

class Progress {
 public:
  /// Draws only if `wanted` and standard error is a terminal.
  explicit Progress(bool wanted);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  /// Draws at most ten times a second. A new stage starts its own clock.
  void update(const char* stage, double done);
  /// Removes the line, so that other messages can be written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool drawing_;
  bool visible_ = false;
  std::string stage_;
  Clock::time_point stage_start_;
  Clock::time_point last_drawn_;
};

}  // namespace medial_vk::cli
