#include "cli/terminal/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/terminal/numbers.h"

namespace medial_vk::cli {

std::string progress_line(const std::string& stage, double done, double elapsed) {
  constexpr int kWidth = 30;
  done = std::clamp(done, 0.0, 1.0);
  const int filled = static_cast<int>(std::lround(done * kWidth));
  std::string line = fmt::format("{:<10} [{:<{}}] {:3.0f} %", stage, std::string(static_cast<std::size_t>(filled), '='),
                                 kWidth, std::floor(done * 100));
  // The first moments are no basis for an estimate.
  if (elapsed > 1.0 && done > 0.01 && done < 1.0) {
    line += fmt::format(", {} left", duration(elapsed * (1.0 - done) / done));
  }
  return line;
}

Progress::Progress(bool wanted) : drawing_(wanted && isatty(STDERR_FILENO) == 1) {}

void Progress::update(const char* stage, double done) {
  if (!drawing_) return;
  const Clock::time_point now = Clock::now();
  const bool new_stage = stage_ != stage;
  if (new_stage) {
    stage_ = stage;
    stage_start_ = now;
  }
  if (!new_stage && now - last_drawn_ < std::chrono::milliseconds(100)) return;
  last_drawn_ = now;
  const double elapsed = std::chrono::duration<double>(now - stage_start_).count();
  fmt::print(stderr, "\r{}\033[K", progress_line(stage_, done, elapsed));
  std::fflush(stderr);
  visible_ = true;
}

void Progress::clear() {
  if (!visible_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  visible_ = false;
}

}  // namespace medial_vk::cli
