#include "cli/terminal/interrupt.h"

#include <atomic>
#include <string_view>

#include "cli/terminal/messages.h"
#include "medial_vk/result.h"
#include "platform/files.h"
#include "platform/processes.h"
#include "platform/signals.h"
#include "platform/terminal.h"

namespace medial_vk::cli {
namespace {

std::atomic<bool> stop_requested{false}, may_end_at_once{false}, on_terminal{false};
std::atomic<bool> has_kept_bodies{false}, has_kept_meshes{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

/// Calls only functions allowed in a handler.
[[noreturn]] void end_at_once() {
  constexpr std::string_view kNothing = "\nmedial-vk: interrupted; nothing was written\n";
  constexpr std::string_view kBodies = "\nmedial-vk: interrupted; the bodies are kept, and nothing else was written\n";
  constexpr std::string_view kMeshes = "\nmedial-vk: interrupted; the meshes that are done are kept\n";
  const std::string_view kept = has_kept_meshes ? kMeshes : has_kept_bodies ? kBodies : kNothing;
  // On a terminal, below the line on which the shell has shown ^C.
  const std::string_view message = kept.substr(on_terminal ? 0 : 1);
  platform::write_all(platform::kStandardError, message);
  platform::end_process(exit_code(ErrorCode::kInterrupted));
}

void request_stop() {
  // The order is opposite to that at the beginning of work, so that one of the two threads always sees the other's
  // write.
  stop_requested = true;
  if (may_end_at_once) end_at_once();
}

}  // namespace

void install_interrupt_handlers() {
  on_terminal = platform::has_terminal();
  platform::on_request_to_stop(request_stop);
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
