// The version of the library.
#pragma once

// The build reads the version from here, too (CMakeLists.txt).
#define MEDIAL_VK_VERSION_MAJOR 0
#define MEDIAL_VK_VERSION_MINOR 1
#define MEDIAL_VK_VERSION_PATCH 0

namespace medial_vk {

/// The version of the linked library, such as "0.1.0"; it may differ from that of the headers.
const char* version();

}  // namespace medial_vk
