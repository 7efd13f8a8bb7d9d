// Stands between the library and Vulkan: makes the k-th call fail, counts created and not destroyed objects, and makes
// a device appear poorer than it is. It is installed through volk's entry point, so the library needs no hook for it.
#pragma once

#include <volk.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "two_queues.h"
#include "work_under_way.h"

namespace medial_vk::test {

enum class Fault {
  kNone,
  kOutOfHostMemory,    // of one call
  kOutOfDeviceMemory,  // of one call
  kDeviceFull,         // from one vkAllocateMemory on, of all
  kDeviceLost,         // from one submission, wait or query on, of all
};

const char* fault_name(Fault fault);

/// The pretended properties of a device. Empty members keep the real value.
struct DeviceProfile {
  bool no_devices = false;
  bool no_compute = false;
  bool no_graphics = false;
  VkFormat missing_format = VK_FORMAT_UNDEFINED;  // of images
  bool never_complete = false;                    // vkEnumeratePhysicalDevices always returns VK_INCOMPLETE
  std::uint32_t api_version = 0;
  std::function<void(VkPhysicalDeviceLimits&)> limits;
  std::optional<VkDeviceSize> max_allocation_bytes;
  std::optional<std::uint32_t> timestamp_valid_bits;
  bool no_subgroup_operations = false;     // subgroups of one invocation, basic operations only
  std::optional<LateQueue> copying_queue;  // another queue, of a family that only copies; the late one of the two
  bool split_memory = false;  // two types: one that only the device sees, one that the host may map (discrete GPUs)
};

/// The greatest requirements of programs and buffers, to compare with limits.
struct Usage {
  std::uint32_t storage_buffers = 0;
  std::uint32_t texel_buffers = 0;
  std::uint32_t buffers = 0;  // both, of one program
  std::uint32_t push_constant_bytes = 0;
  std::uint32_t workgroup_size = 0;
  std::uint32_t shared_bytes = 0;
  std::uint32_t sets = 0;
  std::uint64_t allocations = 0;   // of device memory, at one time
  std::uint64_t memory_bytes = 0;  // the same
};

/// There is one object per process, which is in use from the first call of get() on.
class VulkanInterposer {
 public:
  static VulkanInterposer& get();

  /// For code that queries a loader of its own, not volk. Precondition: get() was called.
  static PFN_vkGetInstanceProcAddr entry();

  /// The k-th call from now on that can fail in this way fails, k = 1, 2, ...
  void fail_call(std::uint64_t k, Fault fault);
  /// Ends all faults; returns the name of the call that failed, empty if none did.
  std::string stop_failing();
  /// Calls since fail_call() that could have failed.
  std::uint64_t calls() const { return calls_; }

  /// Existing handles, by type; those of a pool count with the pool.
  std::map<std::string, std::int64_t> handles() const;
  /// "VkBuffer: 3 more created than destroyed" for types that differ; empty if none does.
  std::string leaks() const;

  void set_profile(DeviceProfile profile);
  const DeviceProfile& profile() const { return profile_; }
  Usage usage() const;
  void clear_usage();
  /// Calls beyond the limits of the profile, and destructions of objects while the device was at work.
  std::vector<std::string> violations() const;

  // For the hooks.
  VkResult next_result(const char* call, unsigned faults);
  void created(const char* type);
  void destroyed(const char* type);
  void allocated(VkDeviceMemory memory, VkDeviceSize bytes);
  void freed(VkDeviceMemory memory);
  void use(const std::function<void(Usage&)>& change);
  void violation(std::string what);
  WorkUnderWay work;
  VkPhysicalDeviceLimits limits{};  // as they were last reported
  TwoQueues two_queues;
  VkQueue queue = VK_NULL_HANDLE;  // the real one
  std::mutex buffers_mutex;
  std::map<VkBuffer, VkDeviceSize> buffer_sizes;

 private:
  VulkanInterposer() = default;
  mutable std::mutex mutex_;
  std::atomic<std::uint64_t> calls_ = 0;
  std::uint64_t fail_at_ = 0;
  Fault fault_ = Fault::kNone;
  std::string failed_;
  std::map<std::string, std::int64_t> created_, destroyed_;
  std::map<VkDeviceMemory, VkDeviceSize> memory_;
  DeviceProfile profile_;
  Usage usage_;
  std::vector<std::string> violations_;
};

/// True if this thread is inside a call of Vulkan: allocations of drivers must not fail.
bool in_driver();
/// The current call, if it can report that host memory has run out; otherwise null.
const char* fallible_call();

}  // namespace medial_vk::test
