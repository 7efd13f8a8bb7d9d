#include "support/source_folder.h"

namespace medial_vk::test {

std::filesystem::path source_folder() { return MEDIAL_VK_SOURCE_DIR; }

}  // namespace medial_vk::test
