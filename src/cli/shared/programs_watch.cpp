#include "cli/shared/programs_watch.h"

#include <fmt/format.h>

#include "platform/signals.h"

namespace medial_vk::cli {

void ProgramsWatch::set_device(const std::string& name) {
  too_slow_ = fmt::format(
      "\nmedial-vk: the driver of {} has been compiling for {} s and goes on. Ctrl-C ends this run; "
      "--list-devices shows other devices, --device chooses one, and --backend cpu needs none.\n",
      name, patience_);
}

void ProgramsWatch::update(std::size_t made, std::size_t total, Progress& progress) {
  if (made == 0) {
    guard_.emplace();
    end_if_interrupted();
    if (progress.is_requested()) platform::set_alarm(patience_, too_slow_);
  }
  progress.update_count("programs", made, total);
  if (made < total) return;
  if (progress.is_requested()) platform::cancel_alarm();
  guard_.reset();
}

}  // namespace medial_vk::cli
