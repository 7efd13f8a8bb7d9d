// A Vulkan device, ready to compute: instance, device, queue, memory, pipelines.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "medial_vk/result.h"

struct VkAllocationCallbacks;  // of vulkan.h, which this header does not need

namespace medial_vk {

/// One physical device as Vulkan lists it.
struct DeviceDescription {
  std::uint32_t index = 0;  ///< Position in Vulkan's enumeration; what ContextOptions::device takes as an index.
  std::string name;
  std::string type;    ///< "discrete", "integrated", "virtual", "cpu" or "other".
  std::string driver;  ///< Driver name and version.
  std::uint32_t api_version = 0;
  std::uint64_t memory_bytes = 0;  ///< Size of the largest device-local heap.
  bool usable = false;             ///< Vulkan 1.2, a compute queue and limits that are high enough.
  std::string why_not;             ///< If not usable: the reason.
};

struct ContextOptions {
  /// An index, or part of a name (case does not matter). Empty: the environment variable MEDIAL_VK_DEVICE, and if
  /// that is unset the best device: discrete, integrated, virtual, then CPU.
  std::string device;
  /// Enables the Khronos validation layer with synchronisation validation; messages are counted and printed.
  bool validation = false;
  /// Folder of the pipeline cache. Empty: $XDG_CACHE_HOME/medial-vk, else $HOME/.cache/medial-vk, else none.
  std::string cache_folder;
  /// Threads of the host for the library's own work on this context (programs, arrays for the device); 0: one per core.
  /// Drivers have threads of their own.
  unsigned threads = 0;
  /// Where Vulkan takes host memory from; null: where its driver likes to. Must stay valid until the context is gone,
  /// and be callable from several threads at once (programs are made on all processors).
  const VkAllocationCallbacks* allocation_callbacks = nullptr;
};

struct HostDevice;  // host_device.h

/// Owns everything Vulkan, or computes on a device that its host owns. Move-only. Any number may be there at once, on
/// any threads: they share nothing. One context, with the scenes on it, is for one thread at a time.
class Context {
 public:
  /// Errors: kNoDevice with what was found and why it will not do, kOutOfMemory.
  static Result<Context> create(const ContextOptions& options = {});
  /// On the host's device, which it must have until the context is gone. Whoever ends the context has waited for what
  /// was recorded or submitted with it. Errors: kNoDevice, which says why it will not do, kOutOfMemory.
  static Result<Context> adopt(const HostDevice& host);
  static Result<std::vector<DeviceDescription>> list_devices();

  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  const DeviceDescription& device() const;
  /// What the destructor begins with: programs are kept for the next process, and destroyed. For a process that ends
  /// without the destructor; made again if they are needed after all.
  void close_programs() noexcept;
  /// Messages of the validation layer (warnings and errors) since creation; 0 without validation.
  std::uint64_t validation_messages() const;

  class Impl;

 private:
  friend struct Internals;
  explicit Context(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
