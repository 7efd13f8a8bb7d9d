#include "common/version.h"

namespace medial_vk {

const char* version() { return MEDIAL_VK_VERSION; }

}  // namespace medial_vk
