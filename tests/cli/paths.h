#pragma once

#include <string>

namespace medial_vk::test {

/// The path of the tool as it was built.
std::string tool_path();

/// Lavapipe with faults on request (tests/faulty_driver).
std::string faulty_driver_path();

/// The file that names chromium's Vulkan driver to the loader; its name ends in NOTFOUND where there is none.
std::string swiftshader_icd_path();

}  // namespace medial_vk::test
