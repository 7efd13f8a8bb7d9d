// What standard error is connected to.
#pragma once

namespace medial_vk::platform {

/// True if it is a terminal that moves its cursor by escape sequences.
bool has_terminal();

}  // namespace medial_vk::platform
