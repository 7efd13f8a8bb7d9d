// The greatest radii of a hull with given centres under linear constraints: a linear program in one to three variables.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace medial_vk {

/// Maximizes the sum of the radii r_i >= least under constraints l . r <= bound that come one by one, for weights l of
/// balls of the hull: not negative, with the sum 1. Where the best radii violate a new constraint, the best ones under
/// all are on its boundary, and at the meeting of so many boundaries as there are variables, so these are enumerated:
/// there are few. The result is exact up to rounding, and depends on the constraints and their order alone.
class RadiusProgram {
 public:
  /// With r_i <= greatest[i]: the first constraints. `count` radii, 1 to 3.
  RadiusProgram(std::size_t count, double least, const std::array<double, 3>& greatest);

  /// False if no radii satisfy all constraints.
  bool is_feasible() const { return is_feasible_; }
  const std::array<double, 3>& radii() const { return radii_; }
  /// Adds a constraint. Returns is_feasible().
  bool add(const std::array<double, 3>& weight, double bound);

 private:
  struct HalfSpace {
    std::array<double, 3> a;  // a . r <= b
    double b;
  };

  bool holds(const std::array<double, 3>& radii, const HalfSpace& space) const;
  void try_meeting(std::size_t wall, std::size_t second, std::size_t third, double& best);

  std::size_t count_;
  std::vector<HalfSpace> spaces_;
  std::array<double, 3> radii_;
  double scale_ = 0;  // the greatest radius, for rounding
  bool is_feasible_ = true;
};

}  // namespace medial_vk
