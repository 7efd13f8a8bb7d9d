// A Vulkan device, ready to compute: instance, device, queue, memory, pipelines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/result.h"

struct VkAllocationCallbacks;  // of vulkan.h, which this header does not include

namespace medial_vk {

/// A limit of Vulkan that the library needs. The device suffices if `there` is at least `needed`.
struct DeviceLimit {
  std::string name;  ///< As in VkPhysicalDeviceLimits.
  std::uint32_t needed = 0;
  std::uint32_t there = 0;
};

struct DeviceHeap {
  std::uint64_t bytes = 0;
  bool is_local = false;  ///< Memory of the device itself.
};

/// Invocations that run together. None are required: with them some kernels are faster.
struct DeviceSubgroups {
  std::uint32_t size = 0;               ///< 0: unknown, of a device below Vulkan 1.1.
  std::vector<std::string> operations;  ///< Those of VkSubgroupFeatureFlagBits that the device has: "basic", "vote" ...
  bool in_compute = false;              ///< Kernels may use them.
};

/// One physical device as Vulkan lists it.
struct DeviceDescription {
  std::uint32_t index = 0;  ///< Position in Vulkan's enumeration, and the index for ContextOptions::device.
  std::string name;
  std::string type;    ///< "discrete", "integrated", "virtual", "cpu" or "other".
  std::string driver;  ///< Driver name and version.
  std::uint32_t api_version = 0;
  std::uint64_t memory_bytes = 0;  ///< Size of the largest device-local heap.
  bool usable = false;             ///< Vulkan 1.2, a compute queue and sufficient limits.
  /// If not usable: every reason, each a phrase such as "it has no compute queue".
  std::vector<std::string> why_not;
  std::vector<DeviceLimit> limits;  ///< All that the library needs.
  std::vector<DeviceHeap> heaps;
  DeviceSubgroups subgroups;
};

/// Reports that `made` of the `total` programs that a call requires have been compiled: 0 in the first report, all in
/// the last. A driver takes from milliseconds to minutes for one program. It is called from any thread, one call at a
/// time, and must not throw.
using ProgramsProgress = std::function<void(std::size_t made, std::size_t total)>;

struct ContextOptions {
  /// An index, or part of a name (case does not matter). Empty: the value of the environment variable MEDIAL_VK_DEVICE;
  /// if that is not set, the best device: discrete, integrated, virtual, then CPU.
  std::string device;
  /// Enables the Khronos validation layer with synchronisation validation; messages are counted and printed.
  bool validation = false;
  /// Of the pipeline cache, UTF-8. Empty: medial-vk in $XDG_CACHE_HOME, $HOME/.cache or %LOCALAPPDATA%; or none.
  std::string cache_folder;
  /// Threads of the host for the library's own work on this context (programs, arrays for the device); 0: one per core.
  /// A call whose options have another number than 0 uses that instead. Drivers have threads of their own.
  unsigned threads = 0;
  /// Vulkan's source of host memory; null: the default of its driver. It must stay valid until the context is
  /// destroyed, and be callable from several threads at once (programs are compiled on `threads` threads).
  const VkAllocationCallbacks* allocation_callbacks = nullptr;
  /// Called when a call requires programs that the context does not have yet: by an extraction or a job for all of
  /// them, by queries of scenes and by unions of balls for each program. It may be called while a progress callback of
  /// the same call runs on another thread.
  ProgramsProgress programs_progress = nullptr;
};

struct HostDevice;  // host_device.h

/// Owns all Vulkan objects, or computes on a device that its host owns. Move-only. Any number of contexts may exist at
/// once, on any threads: they share nothing. A context and the scenes on it are for one thread at a time.
class Context {
 public:
  /// Errors: kNoDevice (the message lists the devices found and the reasons why each is not usable), kOutOfMemory.
  static Result<Context> create(const ContextOptions& options = {});
  /// A context on the host's device, which must outlive it. Precondition of the destructor: all recorded or submitted
  /// work has finished. Errors: kNoDevice (the message gives the reason), kOutOfMemory.
  static Result<Context> adopt(const HostDevice& host);
  /// All physical devices, in Vulkan's order, with the reasons why some are not usable. Errors: kNoDevice (no loader or
  /// no driver of Vulkan), kOutOfMemory.
  static Result<std::vector<DeviceDescription>> list_devices();
  /// The index of the one among `devices`, as list_devices() returns them, that create() opens for this value of
  /// ContextOptions::device. Errors: kNoDevice, as of create(); kOutOfMemory.
  static Result<std::uint32_t> choose_device(std::span<const DeviceDescription> devices,
                                             const std::string& device = {});
  /// The folder of the pipeline cache where ContextOptions::cache_folder is empty; empty: none. Throws std::bad_alloc.
  static std::string default_cache_folder();

  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  const DeviceDescription& device() const;
  /// The first step of the destructor: writes the programs to the pipeline cache for the next process, and destroys
  /// them. For a process that ends without the destructor; programs that are needed afterwards are compiled again.
  void close_programs() noexcept;
  /// Messages of the validation layer (warnings and errors) since creation; 0 without validation.
  std::uint64_t validation_messages() const;

 private:
  friend struct Internals;
  class Impl;
  explicit Context(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
