// Contexts are created and destroyed, many at once and many after each other: memory does not grow.
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "device_commands/recorder.h"
#include "medial_vk/context.h"
#include "support/device/device.h"

namespace medial_vk::test {
namespace {

#if defined(MEDIAL_VK_SANITIZED)
constexpr bool kSanitized = true;  // freed memory stays allocated for a while: its size is not meaningful
#else
constexpr bool kSanitized = false;
#endif

/// Measured on lavapipe (Mesa 22.3): six runs over 1,000 contexts, between -32 and 40 KiB, up and down; nine over 50
/// that load the driver each time, at most 84 KiB. The limit is three times the most: a quarter of a KiB per context
/// for a thousand. A leaked VkDevice costs tens of KiB, an object of Vulkan some hundred bytes.
constexpr double kMostGrowth = 256 * 1024;

/// A context that does not use the user's pipeline cache.
Context make_context() {
  Result<Context> context = Context::create({.device = "", .validation = false, .cache_folder = "/dev/null"});
  if (!context.ok()) throw std::runtime_error(context.error().message);
  return std::move(context).value();
}

/// Pages of this process in memory, in bytes, after the allocator has returned free memory to the system.
std::int64_t resident_bytes() {
  malloc_trim(0);
  std::int64_t total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

/// Opens a device, makes a program and a buffer, fills the buffer on the device.
void use_a_context() {
  Context context = make_context();
  ContextImpl& impl = Internals::of(context);
  const auto program = impl.program({"prepare_resolve", 1, 0, 0, 1, {}});
  ASSERT_TRUE(program.ok()) << program.error().message;
  Arena arena(impl);
  const Result<Buffer> buffer = arena.create_buffer(4096, MemoryKind::kDevice, "a test");
  ASSERT_TRUE(buffer.ok()) << buffer.error().message;
  const auto ran = run_commands(impl, [&](Recorder& r) {
    r.fill(buffer.value(), 0, 4096, 7);
    return r.status();
  });
  ASSERT_TRUE(ran.ok()) << ran.error().message;
}

/// Bytes of growth over `count` contexts after a warm-up of 100: in a fresh process, pools of the driver and of the
/// allocator fill up over the first fifty. Prints the progress.
double growth(std::size_t count) {
  const std::size_t parts = 10, part = std::max<std::size_t>(1, count / parts);
  for (std::size_t i = 0; i < (kSanitized ? 5u : 100u); ++i) use_a_context();
  const std::int64_t start = resident_bytes();
  std::cout << "KiB above the start, every " << part << " contexts:";
  for (std::size_t i = 0; i < parts; ++i) {
    for (std::size_t k = 0; k < part; ++k) use_a_context();
    std::cout << " " << (resident_bytes() - start) / 1024;
  }
  std::cout << "\n";
  return static_cast<double>(resident_bytes() - start);
}

class Contexts : public testing::Test {
 protected:
  void SetUp() override { MEDIAL_VK_SKIP_WITHOUT_DEVICE(); }
};

TEST_F(Contexts, LiveSideBySide) {
  std::vector<Context> contexts;
  for (int i = 0; i < 32; ++i) contexts.push_back(make_context());
  for (Context& context : contexts) {
    Arena arena(Internals::of(context));
    EXPECT_TRUE(arena.create_buffer(4096, MemoryKind::kDevice, "a test").ok());
  }
}

TEST_F(Contexts, AThousandOfThemLeaveNothingBehind) {
  const Context other = make_context();  // keeps the driver loaded, since loading it takes far longer than the rest
  const double bytes = growth(kSanitized ? 20 : 1000);
  if (!kSanitized) {
    EXPECT_LT(bytes, kMostGrowth);
  }
}

TEST_F(Contexts, ThatLoadTheDriverAnewLeaveNothingBehind) {
  const double bytes = growth(kSanitized ? 10 : 50);
  if (!kSanitized) {
    EXPECT_LT(bytes, kMostGrowth);
  }
}

}  // namespace
}  // namespace medial_vk::test
