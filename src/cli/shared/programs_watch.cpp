#include "cli/shared/programs_watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace medial_vk::cli {
namespace {

std::string too_slow;  // the message, made before a signal can come

extern "C" void say_too_slow(int) {
  const int before = errno;  // of the code that the signal interrupts
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, too_slow.data(), too_slow.size());
  errno = before;
}

}  // namespace

void ProgramsWatch::set_device(const std::string& name) {
  too_slow = fmt::format(
      "\nmedial-vk: the driver of {} has been compiling for {} s and goes on. Ctrl-C ends this run; "
      "--list-devices shows other devices, --device chooses one, and --backend cpu needs none.\n",
      name, patience_);
}

void ProgramsWatch::update(std::size_t made, std::size_t total, Progress& progress) {
  if (made == 0) {
    guard_.emplace();
    end_if_interrupted();
    if (progress.is_requested()) {
      std::signal(SIGALRM, say_too_slow);
      ::alarm(patience_);
    }
  }
  progress.update_count("programs", made, total);
  if (made < total) return;
  if (progress.is_requested()) ::alarm(0);
  guard_.reset();
}

}  // namespace medial_vk::cli
