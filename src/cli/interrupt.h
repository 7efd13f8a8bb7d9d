// Ctrl-C and SIGTERM: the first asks the work to stop, the second ends the program at once.
#pragma once

namespace medial_vk::cli {

void install_interrupt_handlers();
bool interrupted();

}  // namespace medial_vk::cli
