// A host's own allocator: the context, a job and their objects take their host memory from it and return it, and the
// validation layer sees no object that is destroyed with another allocator than the one it was created with.
#include <gtest/gtest.h>
#include <medial_vk/extraction_job.h>
#include <medial_vk/host_device.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <unordered_map>

#include "deforming_torus.h"
#include "lent_device.h"
#include "support/device/device.h"
#include "support/indexed.h"
#include "support/recorded_job.h"
#include "vulkan_host.h"

namespace medial_vk::test {
namespace {

class CountingAllocator {
 public:
  CountingAllocator() {
    callbacks_.pUserData = this;
    callbacks_.pfnAllocation = [](void* self, std::size_t bytes, std::size_t alignment, VkSystemAllocationScope) {
      return static_cast<CountingAllocator*>(self)->allocate(bytes, alignment);
    };
    callbacks_.pfnReallocation = [](void* self, void* old, std::size_t bytes, std::size_t alignment,
                                    VkSystemAllocationScope) {
      return static_cast<CountingAllocator*>(self)->reallocate(old, bytes, alignment);
    };
    callbacks_.pfnFree = [](void* self, void* block) { static_cast<CountingAllocator*>(self)->free(block); };
  }
  const VkAllocationCallbacks* callbacks() const { return &callbacks_; }
  std::size_t made() const { return made_; }
  std::size_t foreign() const { return foreign_; }  ///< Returned blocks that were never taken.
  std::size_t alive() const { return sizes_.size(); }

 private:
  void* allocate(std::size_t bytes, std::size_t alignment) {
    alignment = std::max(alignment, sizeof(void*));
    void* block =
        std::aligned_alloc(alignment, (std::max<std::size_t>(bytes, 1) + alignment - 1) / alignment * alignment);
    const std::lock_guard lock(mutex_);
    sizes_[block] = bytes;
    ++made_;
    return block;
  }

  void* reallocate(void* old, std::size_t bytes, std::size_t alignment) {
    void* block = bytes > 0 ? allocate(bytes, alignment) : nullptr;
    if (block != nullptr && old != nullptr) std::memcpy(block, old, std::min(bytes, size_of(old)));
    free(old);
    return block;
  }

  void free(void* block) {
    if (block == nullptr) return;
    const std::lock_guard lock(mutex_);
    if (sizes_.erase(block) == 0) {
      ++foreign_;
    } else {
      std::free(block);
    }
  }

  std::size_t size_of(void* block) {
    const std::lock_guard lock(mutex_);
    return sizes_[block];
  }

  VkAllocationCallbacks callbacks_{};
  std::mutex mutex_;
  std::unordered_map<void*, std::size_t> sizes_;
  std::size_t made_ = 0, foreign_ = 0;
};

TEST(HostAllocator, IsUsedForEverythingAndGetsItBack) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  CountingAllocator allocator;
  VulkanHost vulkan;
  HostDevice host = lend(vulkan);
  host.allocation_callbacks = allocator.callbacks();
  ExtractionOptions options;
  options.resolution = 20;
  options.memory_budget = 256u << 20;
  {
    Result<Context> context = Context::adopt(host);
    ASSERT_TRUE(context.ok()) << context.error().message;
    const DeformingTorus torus(16, 24);
    const std::size_t before = allocator.made();
    const auto job = test::make_job(context.value(), torus.view(), options);
    ASSERT_TRUE(job.ok()) << job.error().message;
    EXPECT_GT(allocator.made(), before);
    EXPECT_TRUE(test::extract_spheres(context.value(), torus.view(), options).ok());
  }
  EXPECT_GT(allocator.made(), 100u);
  EXPECT_EQ(allocator.foreign(), 0u);
  EXPECT_EQ(allocator.alive(), 0u);
  EXPECT_EQ(vulkan.validation_messages(), 0u);
}

}  // namespace
}  // namespace medial_vk::test
