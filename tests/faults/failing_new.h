// operator new that fails at a given allocation of this thread. Linking failing_new.cpp replaces it in the whole
// program.
#pragma once

#include <cstdint>

namespace medial_vk::test {

/// The k-th allocation of this thread within in_runtime() throws std::bad_alloc, k = 1, 2, ...; what Vulkan's drivers
/// allocate does not count: not all of them survive it.
void fail_new(std::uint64_t k);
/// Ends that; did an allocation fail?
bool stop_failing_new();

/// Allocations count as long as one of these is there.
struct CountNew {
  CountNew();
  CountNew(const CountNew&) = delete;
  CountNew& operator=(const CountNew&) = delete;
  ~CountNew();
};

/// Calls the runtime, whose allocations may fail; those of the test itself do not.
template <class Call>
auto in_runtime(const Call& call) {
  const CountNew counted;
  return call();
}

}  // namespace medial_vk::test
