// The goals of a fit, of which estimates decide when they are measured.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "medial_vk/sphere_fits.h"
#include "solid/solid.h"
#include "sphere_fits/quality/measures.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// What balls may reach out, and the boundary may be in them, so that a proof of SphereFitOptions::max_distance to
/// distance_tolerance() succeeds.
inline double near_limit(const SphereFitOptions& options) { return 15.0 / 16 * options.max_distance; }

/// Of the bounds of the measured distance, as a share of the diagonal.
inline double distance_tolerance(const Solid& solid, const SphereFitOptions& options) {
  return std::min(MeasureOptions().tolerance, options.max_distance / (32 * solid.diagonal()));
}

/// Of the best method, inside and balanced. A measurement that fails determines the estimate below which the next one
/// is attempted. Keeps references to the arguments.
class FitGoals {
 public:
  FitGoals(const Solid& solid, const SphereFitOptions& options);

  /// What is known of a set without measurements.
  struct Estimates {
    double error = 0;  ///< A share of the volume, as SphereFitOptions::error.
    double gap = 0;    ///< The widest one at samples of the boundary.
  };

  bool any() const;
  /// Otherwise SphereFitOptions::max_distance, if given, is a bound for the number of balls.
  bool includes_distance() const;

  bool may_be_met(const Estimates& now) const;
  /// By measurements of these balls, where estimates do not suffice. Errors: those of the measures.
  Result<bool> are_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads);
  /// The share of the work that is done, as far as it can be told.
  double share_done(const Estimates& now) const;
  /// The error of a fit of so many balls, after which there are no more.
  Error unmet(const Estimates& now, std::size_t balls) const;

 private:
  Result<bool> distance_is_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads);
  Result<bool> error_is_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads);
  Result<bool> gap_is_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads);

  const Solid& solid_;
  const SphereFitOptions& options_;
  // Estimates below which there is a measurement: of the error, of the gap, and of the gap for the distance.
  double enough_error_, enough_gap_, enough_distance_;
};

}  // namespace medial_vk
