#include "cli/terminal/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "cli/terminal/messages.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {
namespace {

std::atomic<bool> stop_requested{false}, may_end_at_once{false}, on_terminal{false};
std::atomic<bool> has_kept_bodies{false}, has_kept_meshes{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

/// Calls only functions allowed in a handler: write() and _exit().
[[noreturn]] void end_at_once() {
  constexpr std::string_view kNothing = "\nmedial-vk: interrupted; nothing was written\n";
  constexpr std::string_view kBodies = "\nmedial-vk: interrupted; the bodies are kept, and nothing else was written\n";
  constexpr std::string_view kMeshes = "\nmedial-vk: interrupted; the meshes that are done are kept\n";
  const std::string_view kept = has_kept_meshes ? kMeshes : has_kept_bodies ? kBodies : kNothing;
  // On a terminal, below the line on which the shell has shown ^C.
  const std::string_view message = kept.substr(on_terminal ? 0 : 1);
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(exit_code(ErrorCode::kInterrupted));
}

extern "C" void request_stop(int) {
  // The order is opposite to that at the beginning of work, so that one of the two threads always sees the other's
  // write.
  stop_requested = true;
  if (may_end_at_once) end_at_once();
  // From here on either signal ends the program. signal() is safe in a handler.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void install_interrupt_handlers() {
  on_terminal = ::isatty(STDERR_FILENO) == 1;
  struct sigaction action = {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // Reads and writes in progress continue; the flag is tested between them.
  for (const int signal : {SIGINT, SIGTERM}) {
    // A shell that starts a job in the background, and nohup, make it ignore signals on purpose; they remain ignored.
    struct sigaction before = {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);  // A closed pipe is a failed write, with exit code 6.
}

bool interrupted() { return stop_requested; }

void end_if_interrupted() {
  if (stop_requested) end_at_once();
}

void tell_of_kept_bodies() { has_kept_bodies = true; }

void tell_of_kept_meshes() { has_kept_meshes = true; }

EndAtOnce::EndAtOnce() { may_end_at_once = true; }
EndAtOnce::~EndAtOnce() { may_end_at_once = false; }

}  // namespace medial_vk::cli
