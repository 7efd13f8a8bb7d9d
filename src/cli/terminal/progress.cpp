#include "cli/terminal/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/terminal/numbers.h"

namespace medial_vk::cli {

namespace {

std::string bar(const std::string& stage, double done) {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(std::lround(done * kWidth));
  return fmt::format("{:<10} [{:<{}}]", stage, std::string(static_cast<std::size_t>(filled), '='), kWidth);
}

}  // namespace

std::string progress_line(const std::string& stage, double done, double elapsed) {
  done = std::clamp(done, 0.0, 1.0);
  std::string line = fmt::format("{} {:3.0f} %", bar(stage, done), std::floor(done * 100));
  // The first moments are no basis for an estimate.
  if (elapsed > 1.0 && done > 0.01 && done < 1.0) {
    line += fmt::format(", {} left", duration(elapsed * (1.0 - done) / done));
  }
  return line;
}

std::string count_line(const std::string& stage, std::size_t done, std::size_t total) {
  const double share = total > 0 ? static_cast<double>(std::min(done, total)) / static_cast<double>(total) : 1.0;
  return fmt::format("{} {} of {}", bar(stage, share), done, total);
}

Progress::Progress(bool wanted) : drawing_(wanted && isatty(STDERR_FILENO) == 1) {}

bool Progress::is_due(const char* stage) {
  if (!drawing_) return false;
  const Clock::time_point now = Clock::now();
  const bool new_stage = stage_ != stage;
  if (new_stage) {
    stage_ = stage;
    stage_start_ = now;
  }
  if (!new_stage && now - last_drawn_ < std::chrono::milliseconds(100)) return false;
  last_drawn_ = now;
  return true;
}

void Progress::draw(const std::string& line) {
  fmt::print(stderr, "\r{}\033[K", line);
  std::fflush(stderr);
  visible_ = true;
}

void Progress::update(const char* stage, double done) {
  if (!is_due(stage)) return;
  draw(progress_line(stage_, done, std::chrono::duration<double>(last_drawn_ - stage_start_).count()));
}

void Progress::update_count(const char* stage, std::size_t done, std::size_t total) {
  if (is_due(stage)) draw(count_line(stage_, done, total));
}

void Progress::clear() {
  if (!visible_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  visible_ = false;
}

}  // namespace medial_vk::cli
