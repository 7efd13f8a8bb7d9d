// Ctrl-C and SIGTERM: the first asks the work to stop, the second ends the program at once.
#pragma once

namespace medial_vk::cli {

void install_interrupt_handlers();
bool interrupted();

/// While one lives, the first signal ends the program at once, too, with a message and exit code 130. For work that has
/// nothing to undo and cannot be stopped half-way, such as waiting for input that does not come. A signal that came
/// before is not seen again: ask interrupted() once it lives.
class EndAtOnce {
 public:
  EndAtOnce();
  EndAtOnce(const EndAtOnce&) = delete;
  EndAtOnce& operator=(const EndAtOnce&) = delete;
  ~EndAtOnce();
};

}  // namespace medial_vk::cli
