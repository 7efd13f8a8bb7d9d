// What the measurements of distances share.
#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

#include "../helpers.h"
#include "medial_vk/mesh.h"

namespace medial_vk::bench {

/// Of the box around the mesh.
inline double longest_side(const Mesh& mesh) {
  Point lower = mesh.vertices.front(), upper = lower;
  for (const Point& p : mesh.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
}

inline double microseconds_each(std::size_t count, const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
         static_cast<double>(count);
}

/// Of this thread's processor time, which other programs disturb less than the time that passes. For work on one
/// thread.
inline double processor_microseconds_each(std::size_t count, const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  work();
  return (now() - begin) / static_cast<double>(count);
}

}  // namespace medial_vk::bench
