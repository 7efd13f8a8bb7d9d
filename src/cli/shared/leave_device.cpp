#include "cli/shared/leave_device.h"

#include <cstddef>
#include <new>
#include <utility>

namespace medial_vk::cli {
namespace {

// Sanitizers report threads that still run at the end, and memory that a driver points to from regions they do not
// scan.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kIsSanitized = false;
#endif

}  // namespace

void leave_device(std::optional<Context>& context) {
  if (!context || kIsSanitized) return;
  context->close_programs();
  alignas(Context) static std::byte left[sizeof(Context)];  // is never destroyed
  new (left) Context(std::move(*context));
  context.reset();
}

}  // namespace medial_vk::cli
