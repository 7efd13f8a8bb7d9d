// The queries of a boundary: counted, checked, and with the error that their answers are known to have.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "medial_vk/any_boundary.h"
#include "medial_vk/result.h"

namespace medial_vk::any_boundary {

/// Thrown for an answer that is not finite, or farther away than any rounding is allowed for.
struct BadAnswer {
  Point query, answer;
  Error error() const;
};

/// Every call may come from any thread. Keeps a reference to the boundary.
class BoundaryQueries {
 public:
  explicit BoundaryQueries(const BoundaryFunctions& boundary);

  /// Throws BadAnswer, and whatever the boundary's function throws.
  void nearest(std::span<const Point> points, std::span<Point> answers) const;

  bool has_inside() const { return static_cast<bool>(boundary_.contains); }
  /// 1 for all points if the boundary has no inside.
  void contains(std::span<const Point> points, std::span<std::uint8_t> answers) const;

  /// That of the answers, and the rounding of coordinates and distances in double.
  double error() const { return error_; }
  /// The number of queries of nearest points so far.
  std::uint64_t count() const { return count_; }

 private:
  const BoundaryFunctions& boundary_;
  double farthest_;  // that a coordinate may be from 0
  double error_;
  mutable std::atomic<std::uint64_t> count_ = 0;
};

}  // namespace medial_vk::any_boundary
