#include "medial_vk/version.h"

#define MEDIAL_VK_QUOTE(x) #x
#define MEDIAL_VK_TEXT(x) MEDIAL_VK_QUOTE(x)

namespace medial_vk {

const char* version() {
  return MEDIAL_VK_TEXT(MEDIAL_VK_VERSION_MAJOR) "." MEDIAL_VK_TEXT(MEDIAL_VK_VERSION_MINOR) "." MEDIAL_VK_TEXT(
      MEDIAL_VK_VERSION_PATCH);
}

}  // namespace medial_vk
