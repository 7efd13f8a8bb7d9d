// What the measurements of distances share.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <utility>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::bench {

template <typename T>
T or_exit(Result<T> result) {
  if (result.ok()) return std::move(result).value();
  std::fprintf(stderr, "%s\n", result.error().message.c_str());
  std::exit(1);
}

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

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace medial_vk::bench
