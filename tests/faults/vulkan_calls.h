// The calls of Vulkan that are replaced: their list, their possible failures, and the real ones behind them.
#pragma once

#include <volk.h>

#include <atomic>

namespace medial_vk::test::hooks {

// The possible failures of a call.
constexpr unsigned kHost = 1, kDevice = 2, kLost = 4, kAllocates = 8;

// For this thread: its depth inside calls of Vulkan, and the call among them that can report exhausted memory.
inline thread_local int driver_depth = 0;
inline thread_local const char* current_call = nullptr;

/// Held by hooks: neither allocations of the driver nor their own belong to the library.
struct InDriver {
  InDriver() { ++driver_depth; }
  InDriver(const InDriver&) = delete;
  InDriver& operator=(const InDriver&) = delete;
  ~InDriver() { --driver_depth; }
};

/// The replaced function, one for each `Tag`: one loader and one driver suffice for tests.
template <class Tag>
std::atomic<PFN_vkVoidFunction>& real_of() {
  static std::atomic<PFN_vkVoidFunction> real = nullptr;
  return real;
}

template <class Tag, class... Args>
auto call_real(Args... args) {
  return reinterpret_cast<typename Tag::Function>(real_of<Tag>().load())(args...);
}

#define MEDIAL_VK_TAG(call, faults, handle)                         \
  struct call##Tag {                                                \
    using Function = PFN_##call;                                    \
    [[maybe_unused]] static constexpr const char* kName = #call;    \
    [[maybe_unused]] static constexpr unsigned kFaults = faults;    \
    [[maybe_unused]] static constexpr const char* kHandle = handle; \
  };

// Calls that can fail, and the objects that they create.
#define MEDIAL_VK_FALLIBLE(X)                                              \
  X(vkCreateInstance, kHost | kDevice, "VkInstance")                       \
  X(vkCreateDevice, kHost | kDevice | kLost, "VkDevice")                   \
  X(vkCreateBuffer, kHost | kDevice, "VkBuffer")                           \
  X(vkCreateBufferView, kHost | kDevice, "VkBufferView")                   \
  X(vkAllocateMemory, kHost | kDevice | kAllocates, "VkDeviceMemory")      \
  X(vkMapMemory, kHost | kDevice, nullptr)                                 \
  X(vkBindBufferMemory, kHost | kDevice, nullptr)                          \
  X(vkCreateDescriptorSetLayout, kHost | kDevice, "VkDescriptorSetLayout") \
  X(vkCreatePipelineLayout, kHost | kDevice, "VkPipelineLayout")           \
  X(vkCreateShaderModule, kHost | kDevice, "VkShaderModule")               \
  X(vkCreateComputePipelines, kHost | kDevice, "VkPipeline")               \
  X(vkCreatePipelineCache, kHost, "VkPipelineCache")                       \
  X(vkGetPipelineCacheData, kHost | kDevice, nullptr)                      \
  X(vkCreateDescriptorPool, kHost | kDevice, "VkDescriptorPool")           \
  X(vkAllocateDescriptorSets, kHost | kDevice, nullptr)                    \
  X(vkCreateQueryPool, kHost | kDevice, "VkQueryPool")                     \
  X(vkGetQueryPoolResults, kHost | kDevice | kLost, nullptr)               \
  X(vkCreateCommandPool, kHost | kDevice, "VkCommandPool")                 \
  X(vkAllocateCommandBuffers, kHost | kDevice, nullptr)                    \
  X(vkCreateFence, kHost | kDevice, "VkFence")                             \
  X(vkCreateSemaphore, kHost | kDevice, "VkSemaphore")                     \
  X(vkBeginCommandBuffer, kHost | kDevice, nullptr)                        \
  X(vkEndCommandBuffer, kHost | kDevice, nullptr)                          \
  X(vkQueueSubmit, kHost | kDevice | kLost, nullptr)                       \
  X(vkWaitForFences, kHost | kDevice | kLost, nullptr)                     \
  X(vkDeviceWaitIdle, kHost | kDevice | kLost, nullptr)                    \
  X(vkCreateImage, kHost | kDevice, "VkImage")                             \
  X(vkBindImageMemory, kHost | kDevice, nullptr)                           \
  X(vkCreateImageView, kHost | kDevice, "VkImageView")                     \
  X(vkCreateFramebuffer, kHost | kDevice, "VkFramebuffer")                 \
  X(vkCreateRenderPass, kHost | kDevice, "VkRenderPass")                   \
  X(vkCreateSampler, kHost | kDevice, "VkSampler")                         \
  X(vkCreateGraphicsPipelines, kHost | kDevice, "VkPipeline")              \
  X(vkResetCommandPool, kDevice, nullptr)                                  \
  X(vkResetFences, kDevice, nullptr)

#define MEDIAL_VK_DESTROYERS(X)                               \
  X(vkDestroyInstance, 0, "VkInstance")                       \
  X(vkDestroyDevice, 0, "VkDevice")                           \
  X(vkDestroyBuffer, 0, "VkBuffer")                           \
  X(vkDestroyBufferView, 0, "VkBufferView")                   \
  X(vkFreeMemory, 0, "VkDeviceMemory")                        \
  X(vkDestroyDescriptorSetLayout, 0, "VkDescriptorSetLayout") \
  X(vkDestroyPipelineLayout, 0, "VkPipelineLayout")           \
  X(vkDestroyShaderModule, 0, "VkShaderModule")               \
  X(vkDestroyPipeline, 0, "VkPipeline")                       \
  X(vkDestroyPipelineCache, 0, "VkPipelineCache")             \
  X(vkDestroyDescriptorPool, 0, "VkDescriptorPool")           \
  X(vkDestroyQueryPool, 0, "VkQueryPool")                     \
  X(vkDestroyCommandPool, 0, "VkCommandPool")                 \
  X(vkDestroyFence, 0, "VkFence")                             \
  X(vkDestroySemaphore, 0, "VkSemaphore")                     \
  X(vkDestroyImage, 0, "VkImage")                             \
  X(vkDestroyImageView, 0, "VkImageView")                     \
  X(vkDestroyFramebuffer, 0, "VkFramebuffer")                 \
  X(vkDestroyRenderPass, 0, "VkRenderPass")                   \
  X(vkDestroySampler, 0, "VkSampler")

// Calls that are changed or examined, by hand.
#define MEDIAL_VK_OTHERS(X)                               \
  X(vkEnumeratePhysicalDevices, kHost | kDevice, nullptr) \
  X(vkGetPhysicalDeviceProperties, 0, nullptr)            \
  X(vkGetPhysicalDeviceProperties2, 0, nullptr)           \
  X(vkGetPhysicalDeviceQueueFamilyProperties, 0, nullptr) \
  X(vkGetPhysicalDeviceMemoryProperties, 0, nullptr)      \
  X(vkGetPhysicalDeviceFormatProperties, 0, nullptr)      \
  X(vkGetBufferMemoryRequirements2, 0, nullptr)           \
  X(vkUpdateDescriptorSets, 0, nullptr)                   \
  X(vkGetDeviceQueue, 0, nullptr)                         \
  X(vkCmdDispatch, 0, nullptr)                            \
  X(vkCmdDispatchIndirect, 0, nullptr)                    \
  X(vkCmdCopyBuffer, 0, nullptr)                          \
  X(vkCmdFillBuffer, 0, nullptr)                          \
  X(vkCmdBindDescriptorSets, 0, nullptr)                  \
  X(vkCmdBindPipeline, 0, nullptr)                        \
  X(vkCmdWriteTimestamp, 0, nullptr)                      \
  X(vkCmdBeginRenderPass, 0, nullptr)                     \
  X(vkGetDeviceProcAddr, 0, nullptr)

MEDIAL_VK_FALLIBLE(MEDIAL_VK_TAG)
MEDIAL_VK_DESTROYERS(MEDIAL_VK_TAG)
MEDIAL_VK_OTHERS(MEDIAL_VK_TAG)

}  // namespace medial_vk::test::hooks
