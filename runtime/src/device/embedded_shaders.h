// The SPIR-V of shaders/*.comp, compiled and validated by the build.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace medial_vk {

struct EmbeddedShader {
  std::string_view name;  // file name without .comp
  std::span<const std::uint32_t> words;
};

std::span<const EmbeddedShader> embedded_shaders();

}  // namespace medial_vk
