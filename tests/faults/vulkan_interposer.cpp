#include "vulkan_interposer.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "spirv_shared_bytes.h"

namespace medial_vk::test {
namespace {

// How a call may fail.
constexpr unsigned kHost = 1, kDevice = 2, kLost = 4, kAllocates = 8;

unsigned mask_of(Fault fault) {
  switch (fault) {
    case Fault::kOutOfHostMemory:
      return kHost;
    case Fault::kOutOfDeviceMemory:
      return kDevice;
    case Fault::kDeviceFull:
      return kAllocates;
    case Fault::kDeviceLost:
      return kLost;
    case Fault::kNone:
      break;
  }
  return 0;
}

VkResult result_of(Fault fault) {
  switch (fault) {
    case Fault::kOutOfHostMemory:
      return VK_ERROR_OUT_OF_HOST_MEMORY;
    case Fault::kDeviceLost:
      return VK_ERROR_DEVICE_LOST;
    default:
      return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
}

thread_local int driver_depth = 0;
thread_local const char* current_call = nullptr;

/// Hooks have it: neither what the driver allocates nor what they do themselves is the runtime's.
struct InDriver {
  InDriver() { ++driver_depth; }
  InDriver(const InDriver&) = delete;
  InDriver& operator=(const InDriver&) = delete;
  ~InDriver() { --driver_depth; }
};

/// The function that is stood in for, one for each `Tag`: one loader and one driver are enough for tests.
template <class Tag>
std::atomic<PFN_vkVoidFunction>& real_of() {
  static std::atomic<PFN_vkVoidFunction> real = nullptr;
  return real;
}

template <class Tag, class... Args>
auto call_real(Args... args) {
  return reinterpret_cast<typename Tag::Function>(real_of<Tag>().load())(args...);
}

// What a call asks for, before it is made: overloads for those that matter.
template <class Tag, class... Args>
void look_at(Tag, Args...) {}

#define MEDIAL_VK_TAG(call, faults, handle)                         \
  struct call##Tag {                                                \
    using Function = PFN_##call;                                    \
    [[maybe_unused]] static constexpr const char* kName = #call;    \
    [[maybe_unused]] static constexpr unsigned kFaults = faults;    \
    [[maybe_unused]] static constexpr const char* kHandle = handle; \
  };

// Calls that can fail, and what they create.
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

// Calls that are changed or looked at, by hand.
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

void check(VulkanInterposer& self, const char* what, std::uint64_t asked, std::uint64_t limit) {
  if (asked > limit)
    self.violation(std::string(what) + ": " + std::to_string(asked) + " where " + std::to_string(limit) +
                   " is allowed");
}

void look_at(vkCreateDescriptorSetLayoutTag, VkDevice, const VkDescriptorSetLayoutCreateInfo* info,
             const VkAllocationCallbacks*, VkDescriptorSetLayout*) {
  std::uint32_t storage = 0, texels = 0;
  for (std::uint32_t i = 0; i < info->bindingCount; ++i) {
    const bool is_storage = info->pBindings[i].descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    (is_storage ? storage : texels) += info->pBindings[i].descriptorCount;
  }
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "storage buffers of a stage", storage, self.limits.maxPerStageDescriptorStorageBuffers);
  check(self, "storage buffers of a set", storage, self.limits.maxDescriptorSetStorageBuffers);
  check(self, "texel buffers of a stage", texels, self.limits.maxPerStageDescriptorSampledImages);
  check(self, "resources of a stage", storage + texels, self.limits.maxPerStageResources);
  self.use([&](Usage& u) {
    u.storage_buffers = std::max(u.storage_buffers, storage);
    u.texel_buffers = std::max(u.texel_buffers, texels);
    u.buffers = std::max(u.buffers, storage + texels);
  });
}

void look_at(vkCreatePipelineLayoutTag, VkDevice, const VkPipelineLayoutCreateInfo* info, const VkAllocationCallbacks*,
             VkPipelineLayout*) {
  std::uint32_t bytes = 0;
  for (std::uint32_t i = 0; i < info->pushConstantRangeCount; ++i)
    bytes = std::max(bytes, info->pPushConstantRanges[i].offset + info->pPushConstantRanges[i].size);
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "bytes of push constants", bytes, self.limits.maxPushConstantsSize);
  check(self, "bound sets", info->setLayoutCount, self.limits.maxBoundDescriptorSets);
  self.use([&](Usage& u) {
    u.push_constant_bytes = std::max(u.push_constant_bytes, bytes);
    u.sets = std::max(u.sets, info->setLayoutCount);
  });
}

void look_at(vkCreateShaderModuleTag, VkDevice, const VkShaderModuleCreateInfo* info, const VkAllocationCallbacks*,
             VkShaderModule*) {
  const std::uint32_t bytes = spirv_shared_bytes({info->pCode, info->codeSize / sizeof(std::uint32_t)});
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "bytes of shared memory", bytes, self.limits.maxComputeSharedMemorySize);
  self.use([&](Usage& u) { u.shared_bytes = std::max(u.shared_bytes, bytes); });
}

// The runtime's convention: the workgroup's size along x is specialization constant 0, and it is one high and deep.
void look_at(vkCreateComputePipelinesTag, VkDevice, VkPipelineCache, std::uint32_t,
             const VkComputePipelineCreateInfo* info, const VkAllocationCallbacks*, VkPipeline*) {
  std::uint32_t size = 0;
  std::memcpy(&size, info->stage.pSpecializationInfo->pData, sizeof(size));
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "invocations of a workgroup", size, self.limits.maxComputeWorkGroupInvocations);
  check(self, "width of a workgroup", size, self.limits.maxComputeWorkGroupSize[0]);
  self.use([&](Usage& u) { u.workgroup_size = std::max(u.workgroup_size, size); });
}

void look_at(vkCreateBufferViewTag, VkDevice, const VkBufferViewCreateInfo* info, const VkAllocationCallbacks*,
             VkBufferView*) {
  VulkanInterposer& self = VulkanInterposer::get();
  const std::lock_guard lock(self.buffers_mutex);
  const VkDeviceSize bytes =
      info->range == VK_WHOLE_SIZE ? self.buffer_sizes[info->buffer] - info->offset : info->range;
  check(self, "texels of a view", bytes / 16, self.limits.maxTexelBufferElements);
}

// What calls are changed to before the real ones see them: overloads for those that are.
template <class Tag, class... Args>
VkResult make_call(Tag, Args... args) {
  return call_real<Tag>(args...);
}

std::uint32_t mappable_type = 0;  // of the real device

/// Split memory: both types are the first one that the host sees.
VkResult make_call(vkAllocateMemoryTag, VkDevice device, const VkMemoryAllocateInfo* info,
                   const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  VulkanInterposer& self = VulkanInterposer::get();
  VkMemoryAllocateInfo real = *info;
  if (self.profile().split_memory) real.memoryTypeIndex = mappable_type;
  if (const auto& most = self.profile().max_allocation_bytes)
    check(self, "bytes of an allocation", info->allocationSize, *most);
  return call_real<vkAllocateMemoryTag>(device, static_cast<const VkMemoryAllocateInfo*>(&real), callbacks, memory);
}

/// The real device has the first family only.
VkResult make_call(vkCreateDeviceTag, VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                   const VkAllocationCallbacks* callbacks, VkDevice* device) {
  VkDeviceCreateInfo real = *info;
  if (VulkanInterposer::get().profile().copying_queue) real.queueCreateInfoCount = 1;
  return call_real<vkCreateDeviceTag>(physical, static_cast<const VkDeviceCreateInfo*>(&real), callbacks, device);
}

VkResult make_call(vkCreateCommandPoolTag, VkDevice device, const VkCommandPoolCreateInfo* info,
                   const VkAllocationCallbacks* callbacks, VkCommandPool* pool) {
  VkCommandPoolCreateInfo real = *info;
  if (real.queueFamilyIndex == TwoQueues::kCopyingFamily) real.queueFamilyIndex = 0;
  return call_real<vkCreateCommandPoolTag>(device, static_cast<const VkCommandPoolCreateInfo*>(&real), callbacks, pool);
}

VkResult make_call(vkCreateBufferTag, VkDevice device, const VkBufferCreateInfo* info,
                   const VkAllocationCallbacks* callbacks, VkBuffer* buffer) {
  VkBufferCreateInfo real = *info;
  VulkanInterposer& self = VulkanInterposer::get();
  const bool is_shared = info->sharingMode == VK_SHARING_MODE_CONCURRENT && info->queueFamilyIndexCount == 2;
  if (is_shared != self.profile().copying_queue.has_value())
    self.violation("a buffer is shared by families, or not, where it should not be, or should");
  real.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  return call_real<vkCreateBufferTag>(device, static_cast<const VkBufferCreateInfo*>(&real), callbacks, buffer);
}

VkResult make_call(vkQueueSubmitTag, VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
  VulkanInterposer& self = VulkanInterposer::get();
  const std::optional<LateQueue> late = self.profile().copying_queue;
  if (!late) return call_real<vkQueueSubmitTag>(queue, count, infos, fence);
  const auto real = [&self](const VkSubmitInfo& info, VkFence signalled) {
    return call_real<vkQueueSubmitTag>(self.queue, std::uint32_t{1}, &info, signalled);
  };
  return self.two_queues.submit(queue, *infos, fence, *late, real,
                                [&self](std::string what) { self.violation(std::move(what)); });
}

// What somebody waits for has to run in the end.
template <class... Args>
void let_run(VulkanInterposer& self, vkDeviceWaitIdleTag, Args...) {
  self.two_queues.run_until({});
}
void let_run(VulkanInterposer& self, vkWaitForFencesTag, VkDevice, std::uint32_t count, const VkFence* fences, VkBool32,
             std::uint64_t) {
  for (std::uint32_t i = 0; i < count; ++i) self.two_queues.run_until(fences[i]);
}

// After a call that has succeeded: who uses what.
template <class Tag, class... Args>
void follow(WorkUnderWay&, Tag, Args...) {}

constexpr auto as_handle = [](auto h) { return WorkUnderWay::handle(h); };

void follow(WorkUnderWay& work, vkBindBufferMemoryTag, VkDevice, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize) {
  work.depends(as_handle(buffer), as_handle(memory));
}
void follow(WorkUnderWay& work, vkCreateBufferViewTag, VkDevice, const VkBufferViewCreateInfo* info,
            const VkAllocationCallbacks*, VkBufferView* view) {
  work.depends(as_handle(*view), as_handle(info->buffer));
}
void follow(WorkUnderWay& work, vkBindImageMemoryTag, VkDevice, VkImage image, VkDeviceMemory memory, VkDeviceSize) {
  work.depends(as_handle(image), as_handle(memory));
}
void follow(WorkUnderWay& work, vkCreateImageViewTag, VkDevice, const VkImageViewCreateInfo* info,
            const VkAllocationCallbacks*, VkImageView* view) {
  work.depends(as_handle(*view), as_handle(info->image));
}
void follow(WorkUnderWay& work, vkCreateFramebufferTag, VkDevice, const VkFramebufferCreateInfo* info,
            const VkAllocationCallbacks*, VkFramebuffer* framebuffer) {
  for (std::uint32_t i = 0; i < info->attachmentCount; ++i)
    work.depends(as_handle(*framebuffer), as_handle(info->pAttachments[i]));
}
void follow(WorkUnderWay& work, vkAllocateDescriptorSetsTag, VkDevice, const VkDescriptorSetAllocateInfo* info,
            VkDescriptorSet* sets) {
  for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i) {
    work.destroyed(as_handle(sets[i]));
    work.depends(as_handle(sets[i]), as_handle(info->descriptorPool));
  }
}
void follow(WorkUnderWay& work, vkAllocateCommandBuffersTag, VkDevice, const VkCommandBufferAllocateInfo* info,
            VkCommandBuffer* buffers) {
  for (std::uint32_t i = 0; i < info->commandBufferCount; ++i) {
    work.destroyed(as_handle(buffers[i]));
    work.depends(as_handle(buffers[i]), as_handle(info->commandPool));
  }
}
void follow(WorkUnderWay& work, vkBeginCommandBufferTag, VkCommandBuffer commands, const VkCommandBufferBeginInfo*) {
  work.begin(commands);
}
void follow(WorkUnderWay& work, vkQueueSubmitTag, VkQueue, std::uint32_t count, const VkSubmitInfo* infos,
            VkFence fence) {
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t k = 0; k < infos[i].commandBufferCount; ++k) work.submit(infos[i].pCommandBuffers[k], fence);
}
void follow(WorkUnderWay& work, vkWaitForFencesTag, VkDevice, std::uint32_t count, const VkFence* fences, VkBool32,
            std::uint64_t) {
  for (std::uint32_t i = 0; i < count; ++i) work.finished(fences[i]);
}
void follow(WorkUnderWay& work, vkDeviceWaitIdleTag, VkDevice) { work.finished({}); }

template <class Tag, class F>
struct Hook;

/// Calls that can fail.
template <class Tag, class... Args>
struct Hook<Tag, VkResult (*)(Args...)> {
  static VkResult call(Args... args) {
    const InDriver inside;
    VulkanInterposer& self = VulkanInterposer::get();
    const VkResult fault = self.next_result(Tag::kName, Tag::kFaults);
    constexpr bool kWaits = std::is_same_v<Tag, vkWaitForFencesTag> || std::is_same_v<Tag, vkDeviceWaitIdleTag>;
    if constexpr (kWaits) let_run(self, Tag(), args...);
    // A device that is lost does nothing any more: let the real one finish first.
    if constexpr (kWaits) {
      if (fault == VK_ERROR_DEVICE_LOST) {
        self.two_queues.run_until({});
        call_real<vkDeviceWaitIdleTag>(std::get<0>(std::make_tuple(args...)));
        self.work.finished({});
      }
    }
    if (fault != VK_SUCCESS) return fault;
    look_at(Tag(), args...);
    current_call = Tag::kName;
    const VkResult result = make_call(Tag(), args...);
    current_call = nullptr;
    if (result != VK_SUCCESS) return result;
    if constexpr (Tag::kHandle != nullptr) {
      self.created(Tag::kHandle);
      self.work.destroyed(as_handle(*std::get<sizeof...(Args) - 1>(std::make_tuple(args...))));  // what had it before
    }
    follow(self.work, Tag(), args...);
    if constexpr (std::is_same_v<Tag, vkCreateBufferTag>) {
      const std::lock_guard lock(self.buffers_mutex);
      const auto all = std::make_tuple(args...);
      self.buffer_sizes[*std::get<3>(all)] = std::get<1>(all)->size;
    }
    return result;
  }
};

/// Destroyers. The handle is the last argument but one.
template <class Tag, class... Args>
struct Hook<Tag, void (*)(Args...)> {
  static void call(Args... args) {
    const InDriver inside;
    const auto all = std::make_tuple(args...);
    VulkanInterposer& self = VulkanInterposer::get();
    if (std::get<sizeof...(Args) - 2>(all) != VK_NULL_HANDLE) {
      self.destroyed(Tag::kHandle);
      const WorkUnderWay::Handle handle = as_handle(std::get<sizeof...(Args) - 2>(all));
      if (self.work.uses(handle)) self.violation(std::string(Tag::kName) + " of what the device is using");
      self.work.destroyed(handle);
    }
    if constexpr (std::is_same_v<Tag, vkDestroySemaphoreTag>) self.two_queues.forget(std::get<1>(all));
    call_real<Tag>(args...);
  }
};

VkResult enumerate(VkInstance instance, std::uint32_t* count, VkPhysicalDevice* devices) {
  const InDriver inside;
  VulkanInterposer& self = VulkanInterposer::get();
  const VkResult fault = self.next_result("vkEnumeratePhysicalDevices", vkEnumeratePhysicalDevicesTag::kFaults);
  if (fault != VK_SUCCESS) return fault;
  if (self.profile().no_devices) {
    *count = 0;
    return VK_SUCCESS;
  }
  const VkResult result = call_real<vkEnumeratePhysicalDevicesTag>(instance, count, devices);
  return self.profile().never_complete && devices != nullptr ? VK_INCOMPLETE : result;
}

void change(VkPhysicalDeviceProperties& properties) {
  VulkanInterposer& self = VulkanInterposer::get();
  const DeviceProfile& profile = self.profile();
  if (profile.api_version != 0) properties.apiVersion = profile.api_version;
  if (profile.limits) profile.limits(properties.limits);
  self.limits = properties.limits;
}

void get_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
  const InDriver inside;
  call_real<vkGetPhysicalDevicePropertiesTag>(device, properties);
  change(*properties);
}

void get_properties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
  const InDriver inside;
  call_real<vkGetPhysicalDeviceProperties2Tag>(device, properties);
  change(properties->properties);
  const DeviceProfile& profile = VulkanInterposer::get().profile();
  for (auto* next = static_cast<VkBaseOutStructure*>(properties->pNext); next != nullptr; next = next->pNext) {
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES && profile.no_subgroup_operations) {
      auto* subgroup = reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next);
      subgroup->subgroupSize = 1;
      subgroup->supportedStages = VK_SHADER_STAGE_COMPUTE_BIT;
      subgroup->supportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
      subgroup->quadOperationsInAllStages = VK_FALSE;
    }
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES && profile.max_allocation_bytes) {
      reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(next)->maxMemoryAllocationSize =
          *profile.max_allocation_bytes;
    }
  }
}

void get_families(VkPhysicalDevice device, std::uint32_t* count, VkQueueFamilyProperties* families) {
  const InDriver inside;
  const DeviceProfile& profile = VulkanInterposer::get().profile();
  const std::uint32_t room = *count, more = profile.copying_queue ? 1 : 0;
  std::uint32_t real = families != nullptr ? room - more : 0;
  call_real<vkGetPhysicalDeviceQueueFamilyPropertiesTag>(device, &real, families);
  *count = real + more;
  for (std::uint32_t i = 0; families != nullptr && i < real; ++i) {
    if (profile.no_compute) families[i].queueFlags &= ~static_cast<VkQueueFlags>(VK_QUEUE_COMPUTE_BIT);
    if (profile.no_graphics) families[i].queueFlags &= ~static_cast<VkQueueFlags>(VK_QUEUE_GRAPHICS_BIT);
    if (profile.timestamp_valid_bits) families[i].timestampValidBits = *profile.timestamp_valid_bits;
  }
  if (families != nullptr && more != 0)
    families[real] = {.queueFlags = VK_QUEUE_TRANSFER_BIT,
                      .queueCount = 1,
                      .timestampValidBits = 0,
                      .minImageTransferGranularity = {1, 1, 1}};
}

void get_queue(VkDevice device, std::uint32_t family, std::uint32_t index, VkQueue* queue) {
  const InDriver inside;
  if (family == TwoQueues::kCopyingFamily) {
    *queue = TwoQueues::copying_queue();
    return;
  }
  call_real<vkGetDeviceQueueTag>(device, family, index, queue);
  VulkanInterposer::get().queue = *queue;
}

void get_memory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
  const InDriver inside;
  call_real<vkGetPhysicalDeviceMemoryPropertiesTag>(device, memory);
  if (!VulkanInterposer::get().profile().split_memory) return;
  constexpr VkMemoryPropertyFlags kMappable =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  mappable_type = 0;
  while ((memory->memoryTypes[mappable_type].propertyFlags & kMappable) != kMappable) ++mappable_type;
  const std::uint32_t heap = memory->memoryTypes[mappable_type].heapIndex;
  memory->memoryTypeCount = 2;
  memory->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, heap};
  memory->memoryTypes[1] = {kMappable, heap};
}

void get_format(VkPhysicalDevice device, VkFormat format, VkFormatProperties* properties) {
  const InDriver inside;
  call_real<vkGetPhysicalDeviceFormatPropertiesTag>(device, format, properties);
  if (format == VulkanInterposer::get().profile().missing_format) properties->optimalTilingFeatures = 0;
}

void get_requirements(VkDevice device, const VkBufferMemoryRequirementsInfo2* info, VkMemoryRequirements2* out) {
  const InDriver inside;
  call_real<vkGetBufferMemoryRequirements2Tag>(device, info, out);
  if (VulkanInterposer::get().profile().split_memory) out->memoryRequirements.memoryTypeBits = 3;
}

void update_sets(VkDevice device, std::uint32_t count, const VkWriteDescriptorSet* writes, std::uint32_t copies,
                 const VkCopyDescriptorSet* copied) {
  const InDriver inside;
  VulkanInterposer& self = VulkanInterposer::get();
  {
    const std::lock_guard lock(self.buffers_mutex);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (writes[i].descriptorType != VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) continue;
      const VkDescriptorBufferInfo& info = *writes[i].pBufferInfo;
      const VkDeviceSize bytes =
          info.range == VK_WHOLE_SIZE ? self.buffer_sizes[info.buffer] - info.offset : info.range;
      check(self, "bytes of a storage buffer", bytes, self.limits.maxStorageBufferRange);
      if (info.offset % self.limits.minStorageBufferOffsetAlignment != 0)
        self.violation("a storage buffer at " + std::to_string(info.offset));
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const VkWriteDescriptorSet& write = writes[i];
    const bool is_view = write.descriptorType == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    const bool is_storage = write.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    if (is_view) self.work.depends(as_handle(write.dstSet), as_handle(*write.pTexelBufferView));
    if (is_storage) self.work.depends(as_handle(write.dstSet), as_handle(write.pBufferInfo->buffer));
  }
  call_real<vkUpdateDescriptorSetsTag>(device, count, writes, copies, copied);
}

void dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const InDriver inside;
  VulkanInterposer& self = VulkanInterposer::get();
  check(self, "groups along x", x, self.limits.maxComputeWorkGroupCount[0]);
  check(self, "groups along y", y, self.limits.maxComputeWorkGroupCount[1]);
  call_real<vkCmdDispatchTag>(commands, x, y, z);
}

// Commands that use something.
void dispatch_indirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(buffer));
  call_real<vkCmdDispatchIndirectTag>(commands, buffer, offset);
}

void copy_buffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                 const VkBufferCopy* regions) {
  const InDriver inside;
  for (const VkBuffer buffer : {from, to}) VulkanInterposer::get().work.records(commands, as_handle(buffer));
  call_real<vkCmdCopyBufferTag>(commands, from, to, count, regions);
}

void fill_buffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                 std::uint32_t data) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(buffer));
  call_real<vkCmdFillBufferTag>(commands, buffer, offset, size, data);
}

void bind_sets(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout layout, std::uint32_t first,
               std::uint32_t count, const VkDescriptorSet* sets, std::uint32_t offset_count,
               const std::uint32_t* offsets) {
  const InDriver inside;
  for (std::uint32_t i = 0; i < count; ++i) VulkanInterposer::get().work.records(commands, as_handle(sets[i]));
  call_real<vkCmdBindDescriptorSetsTag>(commands, point, layout, first, count, sets, offset_count, offsets);
}

void bind_pipeline(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(pipeline));
  call_real<vkCmdBindPipelineTag>(commands, point, pipeline);
}

void begin_render_pass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info, VkSubpassContents contents) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(info->framebuffer));
  VulkanInterposer::get().work.records(commands, as_handle(info->renderPass));
  call_real<vkCmdBeginRenderPassTag>(commands, info, contents);
}

void write_timestamp(VkCommandBuffer commands, VkPipelineStageFlagBits stage, VkQueryPool pool, std::uint32_t query) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(pool));
  call_real<vkCmdWriteTimestampTag>(commands, stage, pool, query);
}

PFN_vkVoidFunction stand_in(const char* name, PFN_vkVoidFunction real);

PFN_vkVoidFunction get_device_function(VkDevice device, const char* name) {
  const InDriver inside;
  return stand_in(name, call_real<vkGetDeviceProcAddrTag>(device, name));
}

template <class Tag>
PFN_vkVoidFunction keep(PFN_vkVoidFunction real, typename Tag::Function hook) {
  real_of<Tag>() = real;
  return reinterpret_cast<PFN_vkVoidFunction>(hook);
}

/// Ours for those functions that are stood in for, else `real`.
PFN_vkVoidFunction stand_in(const char* name, PFN_vkVoidFunction real) {
  if (real == nullptr) return nullptr;
  const std::string_view wanted = name;
#define MEDIAL_VK_GENERIC(call_name, faults, handle) \
  if (wanted == #call_name) return keep<call_name##Tag>(real, &Hook<call_name##Tag, PFN_##call_name>::call);
  MEDIAL_VK_FALLIBLE(MEDIAL_VK_GENERIC)
  MEDIAL_VK_DESTROYERS(MEDIAL_VK_GENERIC)
  if (wanted == "vkEnumeratePhysicalDevices") return keep<vkEnumeratePhysicalDevicesTag>(real, enumerate);
  if (wanted == "vkGetPhysicalDeviceProperties") return keep<vkGetPhysicalDevicePropertiesTag>(real, get_properties);
  if (wanted == "vkGetPhysicalDeviceProperties2") return keep<vkGetPhysicalDeviceProperties2Tag>(real, get_properties2);
  if (wanted == "vkGetPhysicalDeviceQueueFamilyProperties")
    return keep<vkGetPhysicalDeviceQueueFamilyPropertiesTag>(real, get_families);
  if (wanted == "vkGetPhysicalDeviceMemoryProperties")
    return keep<vkGetPhysicalDeviceMemoryPropertiesTag>(real, get_memory);
  if (wanted == "vkGetPhysicalDeviceFormatProperties")
    return keep<vkGetPhysicalDeviceFormatPropertiesTag>(real, get_format);
  if (wanted == "vkGetBufferMemoryRequirements2")
    return keep<vkGetBufferMemoryRequirements2Tag>(real, get_requirements);
  if (wanted == "vkGetDeviceQueue") return keep<vkGetDeviceQueueTag>(real, get_queue);
  if (wanted == "vkUpdateDescriptorSets") return keep<vkUpdateDescriptorSetsTag>(real, update_sets);
  if (wanted == "vkCmdDispatch") return keep<vkCmdDispatchTag>(real, dispatch);
  if (wanted == "vkCmdDispatchIndirect") return keep<vkCmdDispatchIndirectTag>(real, dispatch_indirect);
  if (wanted == "vkCmdCopyBuffer") return keep<vkCmdCopyBufferTag>(real, copy_buffer);
  if (wanted == "vkCmdFillBuffer") return keep<vkCmdFillBufferTag>(real, fill_buffer);
  if (wanted == "vkCmdBindDescriptorSets") return keep<vkCmdBindDescriptorSetsTag>(real, bind_sets);
  if (wanted == "vkCmdBindPipeline") return keep<vkCmdBindPipelineTag>(real, bind_pipeline);
  if (wanted == "vkCmdWriteTimestamp") return keep<vkCmdWriteTimestampTag>(real, write_timestamp);
  if (wanted == "vkCmdBeginRenderPass") return keep<vkCmdBeginRenderPassTag>(real, begin_render_pass);
  if (wanted == "vkGetDeviceProcAddr") return keep<vkGetDeviceProcAddrTag>(real, get_device_function);
  return real;
}

PFN_vkGetInstanceProcAddr real_entry = nullptr;

PFN_vkVoidFunction get_instance_function(VkInstance instance, const char* name) {
  const InDriver inside;
  return stand_in(name, real_entry(instance, name));
}

}  // namespace

const char* fault_name(Fault fault) {
  switch (fault) {
    case Fault::kOutOfHostMemory:
      return "out of host memory";
    case Fault::kOutOfDeviceMemory:
      return "out of device memory";
    case Fault::kDeviceFull:
      return "device full";
    case Fault::kDeviceLost:
      return "device lost";
    case Fault::kNone:
      break;
  }
  return "none";
}

bool in_driver() { return driver_depth > 0; }
const char* fallible_call() { return current_call; }

VulkanInterposer& VulkanInterposer::get() {
  static VulkanInterposer interposer;
  static const bool installed = [] {
    if (volkInitialize() != VK_SUCCESS) return false;  // no loader: the tests are skipped
    real_entry = vkGetInstanceProcAddr;
    volkInitializeCustom(get_instance_function);
    return true;
  }();
  static_cast<void>(installed);
  return interposer;
}

PFN_vkGetInstanceProcAddr VulkanInterposer::entry() { return get_instance_function; }

void VulkanInterposer::fail_call(std::uint64_t k, Fault fault) {
  const std::lock_guard lock(mutex_);
  calls_ = 0;
  fail_at_ = k;
  fault_ = fault;
  failed_.clear();
}

std::string VulkanInterposer::stop_failing() {
  const std::lock_guard lock(mutex_);
  fault_ = Fault::kNone;
  return failed_;
}

VkResult VulkanInterposer::next_result(const char* call, unsigned faults) {
  const std::lock_guard lock(mutex_);
  if ((faults & mask_of(fault_)) == 0) return VK_SUCCESS;
  const std::uint64_t number = ++calls_;
  const bool lasts = fault_ == Fault::kDeviceLost || fault_ == Fault::kDeviceFull;
  if (lasts ? number < fail_at_ : number != fail_at_) return VK_SUCCESS;
  if (failed_.empty()) failed_ = call;
  return result_of(fault_);
}

void VulkanInterposer::created(const char* type) {
  const std::lock_guard lock(mutex_);
  ++created_[type];
  if (std::strcmp(type, "VkDeviceMemory") == 0) {
    const auto alive = static_cast<std::uint64_t>(created_[type] - destroyed_[type]);
    usage_.allocations = std::max(usage_.allocations, alive);
  }
}

void VulkanInterposer::destroyed(const char* type) {
  const std::lock_guard lock(mutex_);
  ++destroyed_[type];
}

std::map<std::string, std::int64_t> VulkanInterposer::handles() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, std::int64_t> alive = created_;
  for (const auto& [type, count] : destroyed_) alive[type] -= count;
  return alive;
}

std::string VulkanInterposer::leaks() const {
  std::string text;
  for (const auto& [type, count] : handles())
    if (count != 0) text += type + ": " + std::to_string(count) + " more created than destroyed\n";
  return text;
}

void VulkanInterposer::set_profile(DeviceProfile profile) {
  const std::lock_guard lock(mutex_);
  profile_ = std::move(profile);
  violations_.clear();
}

Usage VulkanInterposer::usage() const {
  const std::lock_guard lock(mutex_);
  return usage_;
}

void VulkanInterposer::clear_usage() {
  const std::lock_guard lock(mutex_);
  usage_ = {};
}

void VulkanInterposer::use(const std::function<void(Usage&)>& change_usage) {
  const std::lock_guard lock(mutex_);
  change_usage(usage_);
}

void VulkanInterposer::violation(std::string what) {
  const std::lock_guard lock(mutex_);
  violations_.push_back(std::move(what));
}

std::vector<std::string> VulkanInterposer::violations() const {
  const std::lock_guard lock(mutex_);
  return violations_;
}

}  // namespace medial_vk::test
