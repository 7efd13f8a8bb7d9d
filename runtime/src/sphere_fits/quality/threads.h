// Threads of loops over many balls, points or cells, and their early end.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include "base/parallel.h"

namespace medial_vk {

/// Receives a stage and its finished share; returns false to stop. For one thread at a time.
using SphereProgress = std::function<bool(const char* stage, double done)>;

/// Thrown by loops that are stopped.
struct Stopped {};

struct Threads {
  unsigned count = 0;                  ///< 0: one per core; 1: only the caller's. Results do not depend on it.
  std::function<bool()> goes_on = {};  ///< Called often, from any of them at any time; returns false to stop.

  Threads(unsigned n = 0) : count(n) {}  // NOLINT(google-explicit-constructor): a number is enough
  Threads(unsigned n, std::function<bool()> test) : count(n), goes_on(std::move(test)) {}

  void check() const {
    if (goes_on && !goes_on()) throw Stopped();
  }
};

/// parallel_for() that checks every few items whether to stop. Bodies that take longer than some milliseconds
/// call threads.check() themselves, too.
template <class Body>
void for_all(std::size_t count, std::size_t block, const Threads& threads, Body body) {
  constexpr std::size_t kPeriod = 8;
  const auto run = [&](std::size_t i) {
    if (i % kPeriod == 0) threads.check();
    body(i);
  };
  parallel_for(count, block, threads.count, run);
}

}  // namespace medial_vk
