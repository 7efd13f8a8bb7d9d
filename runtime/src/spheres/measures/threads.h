// How loops over many balls, points or cells run, and how they end early.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include "base/parallel.h"

namespace medial_vk {

/// Stage and share of it done; false: stop. For one thread at a time.
using SphereProgress = std::function<bool(const char* stage, double done)>;

/// Thrown by loops that were told to stop.
struct Stopped {};

struct Threads {
  unsigned count = 0;                  ///< 0: all; 1: no others. Results do not depend on it.
  std::function<bool()> goes_on = {};  ///< Called often, from any of them at any time; false: stop.

  Threads(unsigned n = 0) : count(n) {}  // NOLINT(google-explicit-constructor): a number is enough
  Threads(unsigned n, std::function<bool()> asked) : count(n), goes_on(std::move(asked)) {}

  void check() const {
    if (goes_on && !goes_on()) throw Stopped();
  }
};

/// parallel_for() that checks every few items whether it may go on. Bodies that take longer than some milliseconds
/// call threads.check() themselves, too.
template <class Body>
void for_all(std::size_t count, std::size_t block, const Threads& threads, Body body) {
  constexpr std::size_t kAsked = 8;
  const auto run = [&](std::size_t i) {
    if (i % kAsked == 0) threads.check();
    body(i);
  };
  parallel_for(count, block, threads.count, run);
}

}  // namespace medial_vk
