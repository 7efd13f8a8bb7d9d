// A Vulkan driver that fails on request: lavapipe, with one fault that the variable FAULTY_DRIVER names. The tests of
// `medial-vk doctor` and `medial-vk batch` install it by a driver file of their own.
//
//   crash_at_once, hang_at_once   when the loader opens it
//   crash, hang                   when work is submitted
//   lose_first                    when work is submitted: the device is lost, and the next one that is opened is not
//   skip_work                     dispatches are left out: results are wrong
//   crash_with_cache              when it receives programs of an earlier run
#include <dlfcn.h>
#include <unistd.h>
#include <vulkan/vulkan_core.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

bool has_fault(const char* fault) {
  const char* wanted = std::getenv("FAULTY_DRIVER");
  return wanted != nullptr && std::strcmp(wanted, fault) == 0;
}

void* lavapipe() {
  static void* const library = ::dlopen("libvulkan_lvp.so", RTLD_NOW | RTLD_LOCAL);
  return library;
}

template <class Function>
Function real(const char* name) {
  return lavapipe() != nullptr ? reinterpret_cast<Function>(::dlsym(lavapipe(), name)) : nullptr;
}

/// The signal that a bad pointer causes, without the report of a sanitizer.
void crash() {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
}

void hang() {
  while (true) ::pause();
}

PFN_vkQueueSubmit real_submit = nullptr;
bool is_lost = false;

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
  if (has_fault("crash")) crash();
  if (has_fault("hang")) hang();
  if (has_fault("lose_first")) {
    is_lost = true;
    ::setenv("FAULTY_DRIVER", "none", 1);  // The loader may close this library with the device, and open it again.
  }
  if (is_lost) return VK_ERROR_DEVICE_LOST;
  return real_submit(queue, count, infos, fence);
}

VKAPI_ATTR void VKAPI_CALL leave_out(VkCommandBuffer, std::uint32_t, std::uint32_t, std::uint32_t) {}

PFN_vkCreatePipelineCache real_create_cache = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL create_cache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                            const VkAllocationCallbacks* callbacks, VkPipelineCache* cache) {
  is_lost = false;  // the library makes one for each device
  if (has_fault("crash_with_cache") && info->initialDataSize > 0) crash();
  return real_create_cache(device, info, callbacks, cache);
}

PFN_vkGetDeviceProcAddr real_device_functions = nullptr;

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
  const PFN_vkVoidFunction found = real_device_functions(device, name);
  if (std::strcmp(name, "vkQueueSubmit") == 0) {
    real_submit = reinterpret_cast<PFN_vkQueueSubmit>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(submit);
  }
  if (std::strcmp(name, "vkCreatePipelineCache") == 0) {
    real_create_cache = reinterpret_cast<PFN_vkCreatePipelineCache>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(create_cache);
  }
  if (std::strcmp(name, "vkCmdDispatch") == 0 && has_fault("skip_work"))
    return reinterpret_cast<PFN_vkVoidFunction>(leave_out);
  return found;
}

}  // namespace

// The three functions by which the loader opens a driver.
#pragma GCC visibility push(default)
extern "C" {

VKAPI_ATTR VkResult VKAPI_CALL vk_icdNegotiateLoaderICDInterfaceVersion(std::uint32_t* version) {
  if (has_fault("crash_at_once")) crash();
  if (has_fault("hang_at_once")) hang();
  const auto negotiate = real<VkResult(VKAPI_PTR*)(std::uint32_t*)>("vk_icdNegotiateLoaderICDInterfaceVersion");
  return negotiate != nullptr ? negotiate(version) : VK_ERROR_INCOMPATIBLE_DRIVER;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction found = real<PFN_vkGetInstanceProcAddr>("vk_icdGetInstanceProcAddr")(instance, name);
  if (std::strcmp(name, "vkGetDeviceProcAddr") != 0) return found;
  real_device_functions = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
  return reinterpret_cast<PFN_vkVoidFunction>(device_function);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetPhysicalDeviceProcAddr(VkInstance instance, const char* name) {
  return real<PFN_vkGetInstanceProcAddr>("vk_icdGetPhysicalDeviceProcAddr")(instance, name);
}

}  // extern "C"
#pragma GCC visibility pop
