// How many balls hold each point of a lattice: the volume that a ball would add to their union, estimated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "medial_vk/ball.h"
#include "sphere_fits/steps/zeroed_array.h"

namespace medial_vk {

/// A cubic lattice in a box. The points of a ball follow from the ball alone, so that what comes and goes cancels.
/// Several threads may query it at once, but not beside a change.
class Coverage {
 public:
  Coverage(const Point& lower, const Point& upper);

  /// Another lattice, with so many points per unit of volume (mesh units cubed), or fewer where the box would hold more
  /// than 2^25. `balls`: all that hold points from now on, at most 65,535. Throws std::bad_alloc.
  void divide(double density, std::span<const Ball> balls);
  /// The volume that each point stands for; 0 before divide().
  double cell() const { return spacing_ * spacing_ * spacing_; }

  void add(const Ball& ball);
  /// Precondition: it has been added.
  void remove(const Ball& ball);
  /// The same as remove(from) and add(to), in the time of the points in one of them alone.
  void replace(const Ball& from, const Ball& to);
  /// The volume of this ball's points in no other ball.
  double uncovered(const Ball& ball) const;

 private:
  /// Points of a row.
  struct Range {
    std::size_t begin, end;
  };
  template <class Visit>
  void for_each_row(const Ball& ball, const Visit& visit) const;
  void hold(std::size_t row, const Range& points);
  void release(std::size_t row, const Range& points);
  std::vector<std::pair<std::size_t, Range>> rows_of(const Ball& ball) const;
  template <class Visit>
  void for_each_word(std::size_t row, const Range& points, const Visit& visit) const;

  std::array<std::size_t, 3> axes_ = {0, 1, 2};  // of the box, the longest first: rows are long
  Point lower_{}, sides_{};                      // by axes_, as is what follows
  double spacing_ = 0;
  std::array<std::size_t, 3> size_{};  // points; the first coordinate varies fastest
  ZeroedArray<std::uint16_t> counts_;
  std::size_t words_ = 0;            // of each row in held_
  ZeroedArray<std::uint64_t> held_;  // a bit for each point that a ball holds
};

}  // namespace medial_vk
