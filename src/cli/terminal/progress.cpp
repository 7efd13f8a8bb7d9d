#include "cli/terminal/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/terminal/numbers.h"
#include "platform/files.h"
#include "platform/terminal.h"

namespace medial_vk::cli {

namespace {

constexpr std::chrono::milliseconds kInterval(100);

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

Progress::Progress(bool requested) : requested_(requested), drawing_(requested && platform::has_terminal()) {}

void Progress::draw(const std::string& line) {
  last_drawn_ = Clock::now();
  platform::write_all(platform::kStandardError, fmt::format("\r{}\033[K", line));
  visible_ = true;
}

void Progress::update(const char* stage, double done) {
  const std::lock_guard lock(mutex_);
  if (!drawing_) return;
  const Clock::time_point now = Clock::now();
  const bool new_stage = stage_ != stage;
  if (new_stage) {
    stage_ = stage;
    stage_start_ = now;
  }
  if (!new_stage && now - last_drawn_ < kInterval) return;
  draw(progress_line(stage_, done, std::chrono::duration<double>(now - stage_start_).count()));
}

void Progress::update_count(const char* stage, std::size_t done, std::size_t total) {
  const std::lock_guard lock(mutex_);
  if (drawing_ && (done == 0 || Clock::now() - last_drawn_ >= kInterval)) draw(count_line(stage, done, total));
}

void Progress::clear() {
  const std::lock_guard lock(mutex_);
  if (!visible_) return;
  platform::write_all(platform::kStandardError, "\r\033[K");
  visible_ = false;
}

}  // namespace medial_vk::cli
