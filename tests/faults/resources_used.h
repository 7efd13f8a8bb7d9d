// Records the users of resources, from the calls that have succeeded and the commands that were recorded
// (WorkUnderWay).
#pragma once

#include "limit_checks.h"
#include "vulkan_calls.h"
#include "vulkan_interposer.h"

namespace medial_vk::test::hooks {

// After a call that has succeeded: records the users of its resources.
template <class Tag, class... Args>
void follow(WorkUnderWay&, Tag, Args...) {}

template <class T>
WorkUnderWay::Handle as_handle(T vulkan_handle) {
  return WorkUnderWay::handle(vulkan_handle);
}

inline void follow(WorkUnderWay& work, vkBindBufferMemoryTag, VkDevice, VkBuffer buffer, VkDeviceMemory memory,
                   VkDeviceSize) {
  work.depends(as_handle(buffer), as_handle(memory));
}
inline void follow(WorkUnderWay& work, vkCreateBufferViewTag, VkDevice, const VkBufferViewCreateInfo* info,
                   const VkAllocationCallbacks*, VkBufferView* view) {
  work.depends(as_handle(*view), as_handle(info->buffer));
}
inline void follow(WorkUnderWay& work, vkBindImageMemoryTag, VkDevice, VkImage image, VkDeviceMemory memory,
                   VkDeviceSize) {
  work.depends(as_handle(image), as_handle(memory));
}
inline void follow(WorkUnderWay& work, vkCreateImageViewTag, VkDevice, const VkImageViewCreateInfo* info,
                   const VkAllocationCallbacks*, VkImageView* view) {
  work.depends(as_handle(*view), as_handle(info->image));
}
inline void follow(WorkUnderWay& work, vkCreateFramebufferTag, VkDevice, const VkFramebufferCreateInfo* info,
                   const VkAllocationCallbacks*, VkFramebuffer* framebuffer) {
  for (std::uint32_t i = 0; i < info->attachmentCount; ++i)
    work.depends(as_handle(*framebuffer), as_handle(info->pAttachments[i]));
}
inline void follow(WorkUnderWay& work, vkAllocateDescriptorSetsTag, VkDevice, const VkDescriptorSetAllocateInfo* info,
                   VkDescriptorSet* sets) {
  for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i) {
    work.destroyed(as_handle(sets[i]));
    work.depends(as_handle(sets[i]), as_handle(info->descriptorPool));
  }
}
inline void follow(WorkUnderWay& work, vkAllocateCommandBuffersTag, VkDevice, const VkCommandBufferAllocateInfo* info,
                   VkCommandBuffer* buffers) {
  for (std::uint32_t i = 0; i < info->commandBufferCount; ++i) {
    work.destroyed(as_handle(buffers[i]));
    work.depends(as_handle(buffers[i]), as_handle(info->commandPool));
  }
}
inline void follow(WorkUnderWay& work, vkBeginCommandBufferTag, VkCommandBuffer commands,
                   const VkCommandBufferBeginInfo*) {
  work.begin(commands);
}
inline void follow(WorkUnderWay& work, vkQueueSubmitTag, VkQueue, std::uint32_t count, const VkSubmitInfo* infos,
                   VkFence fence) {
  for (std::uint32_t i = 0; i < count; ++i) work.submit(infos[i], fence);
}
inline void follow(WorkUnderWay& work, vkWaitForFencesTag, VkDevice, std::uint32_t count, const VkFence* fences,
                   VkBool32, std::uint64_t) {
  for (std::uint32_t i = 0; i < count; ++i) work.finished(fences[i]);
}
inline void follow(WorkUnderWay& work, vkDeviceWaitIdleTag, VkDevice) { work.finished({}); }

inline void update_sets(VkDevice device, std::uint32_t count, const VkWriteDescriptorSet* writes, std::uint32_t copies,
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

// Commands that use resources.
inline void dispatch_indirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(buffer));
  call_real<vkCmdDispatchIndirectTag>(commands, buffer, offset);
}

inline void copy_buffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                        const VkBufferCopy* regions) {
  const InDriver inside;
  for (const VkBuffer buffer : {from, to}) VulkanInterposer::get().work.records(commands, as_handle(buffer));
  call_real<vkCmdCopyBufferTag>(commands, from, to, count, regions);
}

inline void fill_buffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                        std::uint32_t data) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(buffer));
  call_real<vkCmdFillBufferTag>(commands, buffer, offset, size, data);
}

inline void bind_sets(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout layout, std::uint32_t first,
                      std::uint32_t count, const VkDescriptorSet* sets, std::uint32_t offset_count,
                      const std::uint32_t* offsets) {
  const InDriver inside;
  for (std::uint32_t i = 0; i < count; ++i) VulkanInterposer::get().work.records(commands, as_handle(sets[i]));
  call_real<vkCmdBindDescriptorSetsTag>(commands, point, layout, first, count, sets, offset_count, offsets);
}

inline void bind_pipeline(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(pipeline));
  call_real<vkCmdBindPipelineTag>(commands, point, pipeline);
}

inline void begin_render_pass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info, VkSubpassContents contents) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(info->framebuffer));
  VulkanInterposer::get().work.records(commands, as_handle(info->renderPass));
  call_real<vkCmdBeginRenderPassTag>(commands, info, contents);
}

inline void write_timestamp(VkCommandBuffer commands, VkPipelineStageFlagBits stage, VkQueryPool pool,
                            std::uint32_t query) {
  const InDriver inside;
  VulkanInterposer::get().work.records(commands, as_handle(pool));
  call_real<vkCmdWriteTimestampTag>(commands, stage, pool, query);
}

}  // namespace medial_vk::test::hooks
