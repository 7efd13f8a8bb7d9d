// The memory of long runs.
#include <gtest/gtest.h>

#include <cstdlib>

#include "platform/machine.h"

#if defined(__GLIBC__)
#include <malloc.h>

namespace medial_vk::platform {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

/// Whether a new block of that size is a mapping of its own, which the system gets back with free().
bool is_own_mapping(std::size_t bytes) {
  const auto before = ::mallinfo2().hblks;
  void* volatile block = std::malloc(bytes);
  const bool is_one_more = ::mallinfo2().hblks == before + 1;
  std::free(block);
  return is_one_more && ::mallinfo2().hblks == before;
}

TEST(Memory, LargeBlocksGoBackToTheSystemAfterALargerOneWasFreed) {
  // No block of 64 MiB is ever kept.
  if (!is_own_mapping(64 * kMiB)) GTEST_SKIP() << "malloc() is not that of GNU";
  return_large_blocks();
  // Without the call, the first one makes the process keep the second.
  EXPECT_TRUE(is_own_mapping(30 * kMiB));
  EXPECT_TRUE(is_own_mapping(2 * kMiB));
}

}  // namespace
}  // namespace medial_vk::platform
#endif
