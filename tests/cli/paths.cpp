#include "paths.h"

namespace medial_vk::test {

std::string tool_path() { return MEDIAL_VK_BINARY; }

std::string faulty_driver_path() { return MEDIAL_VK_FAULTY_DRIVER; }

std::string swiftshader_icd_path() { return MEDIAL_VK_SWIFTSHADER_ICD; }

}  // namespace medial_vk::test
