#pragma once

namespace medial_vk {

/// "0.1.0": set by the build, written to every output.
const char* version();

}  // namespace medial_vk
