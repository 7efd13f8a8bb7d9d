// The functions of Vulkan that draw a picture. They are loaded at run time, so that the program starts without a Vulkan
// loader, into tables of their own (the runtime has separate ones).
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

namespace medial_vk::picture {

#define MEDIAL_VK_PICTURE_INSTANCE_FUNCTIONS(X) \
  X(CreateDevice)                               \
  X(DestroyInstance)                            \
  X(EnumeratePhysicalDevices)                   \
  X(GetDeviceProcAddr)                          \
  X(GetPhysicalDeviceFormatProperties)          \
  X(GetPhysicalDeviceMemoryProperties)          \
  X(GetPhysicalDeviceProperties)                \
  X(GetPhysicalDeviceQueueFamilyProperties)

// clang-format off: it would write them in steps
#define MEDIAL_VK_PICTURE_DEVICE_FUNCTIONS(X) \
  X(AllocateCommandBuffers)                   \
  X(AllocateDescriptorSets)                   \
  X(AllocateMemory)                           \
  X(BeginCommandBuffer)                       \
  X(BindBufferMemory)                         \
  X(BindImageMemory)                          \
  X(CmdBeginRenderPass)                       \
  X(CmdBindDescriptorSets)                    \
  X(CmdBindPipeline)                          \
  X(CmdBindVertexBuffers)                     \
  X(CmdCopyImageToBuffer)                     \
  X(CmdDraw)                                  \
  X(CmdEndRenderPass)                         \
  X(CmdPipelineBarrier)                       \
  X(CmdPushConstants)                         \
  X(CreateBuffer)                             \
  X(CreateCommandPool)                        \
  X(CreateDescriptorPool)                     \
  X(CreateDescriptorSetLayout)                \
  X(CreateFence)                              \
  X(CreateFramebuffer)                        \
  X(CreateGraphicsPipelines)                  \
  X(CreateImage)                              \
  X(CreateImageView)                          \
  X(CreatePipelineLayout)                     \
  X(CreateRenderPass)                         \
  X(CreateSampler)                            \
  X(CreateShaderModule)                       \
  X(DestroyBuffer)                            \
  X(DestroyCommandPool)                       \
  X(DestroyDescriptorPool)                    \
  X(DestroyDescriptorSetLayout)               \
  X(DestroyDevice)                            \
  X(DestroyFence)                             \
  X(DestroyFramebuffer)                       \
  X(DestroyImage)                             \
  X(DestroyImageView)                         \
  X(DestroyPipeline)                          \
  X(DestroyPipelineLayout)                    \
  X(DestroyRenderPass)                        \
  X(DestroySampler)                           \
  X(DestroyShaderModule)                      \
  X(DeviceWaitIdle)                           \
  X(EndCommandBuffer)                         \
  X(FreeMemory)                               \
  X(GetBufferMemoryRequirements)              \
  X(GetDeviceQueue)                           \
  X(GetImageMemoryRequirements)               \
  X(MapMemory)                                \
  X(QueueSubmit)                              \
  X(ResetCommandPool)                         \
  X(ResetFences)                              \
  X(UpdateDescriptorSets)                     \
  X(WaitForFences)
// clang-format on

#define MEDIAL_VK_PICTURE_DECLARE(name) PFN_vk##name name = nullptr;

struct InstanceFunctions {
  MEDIAL_VK_PICTURE_INSTANCE_FUNCTIONS(MEDIAL_VK_PICTURE_DECLARE)
};

struct DeviceFunctions {
  MEDIAL_VK_PICTURE_DEVICE_FUNCTIONS(MEDIAL_VK_PICTURE_DECLARE)
};

#undef MEDIAL_VK_PICTURE_DECLARE

template <class T>
T vulkan_struct(VkStructureType type) {
  T made{};
  made.sType = type;
  return made;
}

}  // namespace medial_vk::picture
