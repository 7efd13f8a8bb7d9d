// Ctrl-C, requests to end, and alarms. Handlers may call write_all(), end_process() and lock-free atomics only.
#pragma once

#include <functional>
#include <string>

namespace medial_vk::platform {

/// Calls `handler` at the first Ctrl-C or SIGTERM (on Windows: Ctrl-C or Ctrl-Break, in a thread of its own); the
/// second ends the program. Where the program that started this one had it ignore them, they remain ignored. A closed
/// pipe becomes a failed write.
void on_request_to_stop(void (*handler)());

/// Runs `work` and returns its result: on Windows in a thread of its own, while this one waits. Wine interrupts the
/// first thread of a process by a signal, whose handler starts the thread for Ctrl-C; where the first thread is in
/// malloc() of a driver at that moment, that handler waits for the lock of malloc() forever.
int run_apart_from_signals(const std::function<int()>& work);

/// Writes `message` to standard error after that many seconds, unless cancel_alarm() is called before. One at a time.
void set_alarm(unsigned seconds, const std::string& message);
void cancel_alarm();

}  // namespace medial_vk::platform
