#include "cli/interrupt.h"

#include <atomic>
#include <csignal>

namespace medial_vk::cli {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

extern "C" void request_stop(int) {
  stop_requested.store(true, std::memory_order_relaxed);
  // From now on either signal kills. signal() is safe in a handler.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void install_interrupt_handlers() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // Reads and writes under way go on; the flag is seen between them.
  for (const int signal : {SIGINT, SIGTERM}) {
    // A shell that starts a job in the background, and nohup, ignore signals on purpose: leave it so.
    struct sigaction before = {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);  // A closed pipe is a failed write, exit code 6.
}

bool interrupted() { return stop_requested.load(std::memory_order_relaxed); }

}  // namespace medial_vk::cli
