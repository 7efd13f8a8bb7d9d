// Ctrl-C and SIGTERM: the first signal requests a stop of the work, the second ends the program at once.
#pragma once

namespace medial_vk::cli {

void install_interrupt_handlers();
bool interrupted();
/// Ends the program if a signal has arrived, with the message and exit code of EndAtOnce.
void end_if_interrupted();

/// From here on the message of EndAtOnce says that bodies were kept: `medial-vk clearance` writes them before it goes
/// on.
void tell_of_kept_bodies();

/// From here on that message says that results of meshes are kept: `medial-vk batch` writes those of each mesh at once.
void tell_of_kept_meshes();

/// While an object exists, the first signal also ends the program at once, with a message and exit code 130. It is for
/// work that has nothing to undo and cannot be stopped half-way, such as a wait for input that does not come. Signals
/// before construction are not handled here: call interrupted() after construction.
class EndAtOnce {
 public:
  EndAtOnce();
  EndAtOnce(const EndAtOnce&) = delete;
  EndAtOnce& operator=(const EndAtOnce&) = delete;
  ~EndAtOnce();
};

}  // namespace medial_vk::cli
