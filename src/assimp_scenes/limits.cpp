#include "assimp_scenes/limits.h"

#include "platform/processes.h"

namespace medial_vk {
namespace {

// With assimp 5.2, half a million triangles take 4 to 17 times the length of the file, and 83 times that of a 3MF,
// which is compressed; 8 to 140 MB are read per second.
constexpr std::uint64_t kLeastMemory = 2ull << 30;
constexpr std::uint64_t kMemoryPerByte = 128;
constexpr std::uint64_t kLeastSeconds = 60;
constexpr std::uint64_t kBytesPerSecond = 1u << 20;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;  // the shadow memory takes all of the address space
#elif defined(__has_feature)
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kIsSanitized = false;
#endif

std::uint64_t allowed_bytes = 0;

void set_limits() {
  platform::limit_use(kIsSanitized ? 0 : kLeastMemory + kMemoryPerByte * allowed_bytes,
                      kLeastSeconds + allowed_bytes / kBytesPerSecond);
}

}  // namespace

void limit_this_process(std::uint64_t file_bytes) {
  platform::limit_this_process();
  allowed_bytes = file_bytes;
  set_limits();
}

void allow_for(std::uint64_t file_bytes) {
  if (allowed_bytes == 0) return;  // a process without limits
  allowed_bytes += file_bytes;
  set_limits();
}

}  // namespace medial_vk
