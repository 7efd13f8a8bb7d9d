// A progress line on the terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace medial_vk::cli {

/// "extract    [============            ]  50 %, 12 s left". `done` is 0 to 1; `elapsed` is in seconds since the stage
/// began; the remaining time is left out until it can be estimated.
std::string progress_line(const std::string& stage, double done, double elapsed);

/// "programs   [============            ] 12 of 29".
std::string count_line(const std::string& stage, std::size_t done, std::size_t total);

/// The functions may be called from any thread: programs are compiled while other parts of a robot are fitted.
class Progress {
 public:
  /// Draws only if `requested` and standard error is a terminal.
  explicit Progress(bool requested);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }
  /// True if messages were requested, on a terminal or elsewhere.
  bool is_requested() const { return requested_; }

  /// Draws at most ten times a second. A new stage starts its own clock.
  void update(const char* stage, double done);
  /// Draws numbers instead, and does not change the clock of the stage.
  void update_count(const char* stage, std::size_t done, std::size_t total);
  /// Removes the line, so that other messages can be written.
  void clear();

 private:
  void draw(const std::string& line);

  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;  // of all that follows
  bool requested_;
  bool drawing_;
  bool visible_ = false;
  std::string stage_;
  Clock::time_point stage_start_;
  Clock::time_point last_drawn_;
};

}  // namespace medial_vk::cli
