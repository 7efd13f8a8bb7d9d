// The internal interface of a context: the dispatch table, limits and a cache of programs.
#pragma once

#include <volk.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "device/embedded_shaders.h"
#include "device/instance.h"
#include "device/internals.h"
#include "device/pipeline_cache.h"
#include "device/program.h"
#include "medial_vk/context.h"

namespace medial_vk {

class Context::Impl {
 public:
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();

  VolkDeviceTable vk{};  // every device call goes through here, never through volk's globals
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  // A queue of a family that only copies, while kernels run. Null: the device has none, or a host owns it.
  VkQueue transfer_queue = VK_NULL_HANDLE;
  std::uint32_t transfer_family = 0;
  const VkAllocationCallbacks* allocation_callbacks = nullptr;

  unsigned host_threads = 0;           // ContextOptions::threads, or of the present call (ThreadsOfCall)
  ProgramsProgress programs_progress;  // ContextOptions::programs_progress
  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceMemoryProperties memory{};
  VkPhysicalDeviceSubgroupProperties subgroup{};
  VkDeviceSize max_allocation_bytes = 0;  // of one vkAllocateMemory (maxMemoryAllocationSize)
  bool is_llvmpipe = false;               // Mesa's driver for processors (lavapipe)
  // True if eight neighbouring invocations run in lockstep in one subgroup with shuffles
  // (shaders/shared/lanes/lanes.glsl): on llvmpipe, whose subgroups are the lanes of a vector, filled in order;
  // elsewhere nothing guarantees it. Tests clear it.
  bool has_lockstep_lanes = false;
  // Number of runs of neighbouring workgroups into which a dispatch is divided, one for each thread of a processor that
  // runs shaders (llvmpipe); 1: not divided. A wrong number affects only the balance of the threads. Tests change it.
  std::uint32_t dispatch_threads = 1;
  std::uint32_t timestamp_valid_bits = 0;  // 0: the queue has no timestamps
  DeviceDescription description;
  // Written by the validation layer from any thread (through atomic_ref); this object must not move.
  std::uint64_t validation_messages = 0;
  // Shaders that take precedence over the embedded ones, such as kernels of a test.
  std::span<const EmbeddedShader> extra_shaders;

  /// The program for this shader and these specialization constants, compiled once and kept until the context is
  /// destroyed.
  /// Errors: kInternal (unknown shader, the driver refuses it), kOutOfMemory.
  Result<const Program*> program(const ProgramKey& key);
  /// Compiles the missing ones, on `host_threads` threads. Errors: as program(), of the first that fails.
  Status make_programs(const std::set<ProgramKey>& keys);

 private:
  friend class Context;
  Status initialize(const ContextOptions& options);
  Status adopt(const HostDevice& host);
  Status create_device(std::optional<std::uint32_t> copying_family);
  void query_properties();
  Status open_pipeline_cache(const std::string& folder_option);
  void save_pipeline_cache() noexcept;  // writes the file, if there is anything new
  void close_programs() noexcept;
  const EmbeddedShader* shader(const ProgramKey& key) const;
  Result<OwnedProgram> build_program(const ProgramKey& key) const;

  bool owns_device_ = true;  // false: the host owns the device and the instance
  Instance instance_;        // owns `instance`
  PipelineCacheIdentity pipeline_cache_identity_;
  VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
  std::string pipeline_cache_file_;            // empty: none
  std::uint64_t pipeline_cache_checksum_ = 0;  // of the data that was read
  std::map<ProgramKey, OwnedProgram> programs_;
};

/// While it exists, the context uses the number of threads of a call; 0: its own.
class ThreadsOfCall {
 public:
  ThreadsOfCall(ContextImpl& context, unsigned threads) : context_(context), before_(context.host_threads) {
    if (threads != 0) context.host_threads = threads;
  }
  ThreadsOfCall(const ThreadsOfCall&) = delete;
  ThreadsOfCall& operator=(const ThreadsOfCall&) = delete;
  ~ThreadsOfCall() { context_.host_threads = before_; }

 private:
  ContextImpl& context_;
  unsigned before_;
};

/// "vkCreateBuffer failed: out of device memory"; kOutOfMemory for the two memory results, else kInternal.
Error vulkan_error(const char* call, VkResult result);

}  // namespace medial_vk
