// An operator new that fails at a given allocation of this thread. Linking failing_new.cpp replaces operator new in the
// whole program.
#pragma once

#include <cstdint>

namespace medial_vk::test {

/// The k-th allocation of this thread within in_runtime() throws std::bad_alloc, k = 1, 2, ...; allocations of Vulkan's
/// drivers do not count, since not all drivers survive a failure.
void fail_new(std::uint64_t k);
/// Ends the fault; true if an allocation has failed.
bool stop_failing_new();

/// Allocations count while an object of this class exists.
struct CountNew {
  CountNew();
  CountNew(const CountNew&) = delete;
  CountNew& operator=(const CountNew&) = delete;
  ~CountNew();
};

/// Calls the library, whose allocations may fail; those of the test itself may not.
template <class Call>
auto in_runtime(const Call& call) {
  const CountNew counted;
  return call();
}

}  // namespace medial_vk::test
