// Ctrl-C, requests to end, and alarms. Handlers may call write_all(), end_process() and lock-free atomics only.
#pragma once

#include <string>

namespace medial_vk::platform {

/// Calls `handler` at the first Ctrl-C or SIGTERM (on Windows: Ctrl-C or Ctrl-Break, in a thread of its own); the
/// second ends the program. Where the program that started this one had it ignore them, they remain ignored. A closed
/// pipe becomes a failed write.
void on_request_to_stop(void (*handler)());

/// Writes `message` to standard error after that many seconds, unless cancel_alarm() is called before. One at a time.
void set_alarm(unsigned seconds, const std::string& message);
void cancel_alarm();

}  // namespace medial_vk::platform
