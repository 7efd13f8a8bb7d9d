// A compute pipeline with its layout. All shaders share one convention: set 0, storage buffers at bindings
// 0 .. storage_buffers - 1, uniform texel buffers after them, push constants of at most 128 bytes, the workgroup
// size in specialization constant 0.
#pragma once

#include <volk.h>

#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace medial_vk {

struct ProgramKey {
  std::string shader;  // file name without .comp
  std::uint32_t storage_buffers = 0;
  std::uint32_t texel_buffers = 0;
  std::uint32_t push_constant_bytes = 0;
  std::uint32_t workgroup_size = 64;     // specialization constant 0
  std::vector<std::uint32_t> constants;  // specialization constants 1, 2, ...

  auto operator<=>(const ProgramKey&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
};

/// The suffix of the name of a shader that reads the mesh (cmake/EmbedShaders.cmake).
inline const char* storage_suffix(bool use_texels) { return use_texels ? "" : "_storage"; }

/// Plain handles, which belong to an OwnedProgram.
struct Program {
  ProgramKey key;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// Destroys the existing handles, and the object.
struct ProgramDeleter {
  const VolkDeviceTable* vk = nullptr;
  VkDevice device = VK_NULL_HANDLE;
  const VkAllocationCallbacks* allocation_callbacks = nullptr;
  void operator()(Program* program) const;
};
/// The context's cache of programs keeps them.
using OwnedProgram = std::unique_ptr<Program, ProgramDeleter>;

}  // namespace medial_vk
