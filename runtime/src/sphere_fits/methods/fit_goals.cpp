#include "sphere_fits/methods/fit_goals.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/format_text.h"
#include "sphere_fits/quality/envelope_distance.h"
#include "sphere_fits/quality/measures.h"

namespace medial_vk {
namespace {

constexpr double kGapTolerance = 0.01;  // of the bounds of the greatest gap, as a share of the goal
constexpr double kLess = 0.999;         // than the present estimate, so that there are fewer measurements
constexpr double kLessDistance = 0.98;  // likewise, where a measurement takes long

}  // namespace

FitGoals::FitGoals(const Solid& solid, const SphereFitOptions& options)
    : solid_(solid),
      options_(options),
      enough_error_(options.error),
      enough_gap_(options.max_gap),
      enough_distance_(options.max_distance) {}

bool FitGoals::any() const { return options_.error > 0 || options_.max_gap > 0 || includes_distance(); }

bool FitGoals::includes_distance() const {
  return options_.max_distance > 0 && (options_.count == 0 || options_.error > 0 || options_.max_gap > 0);
}

bool FitGoals::may_be_met(const Estimates& now) const {
  return (options_.error <= 0 || now.error <= enough_error_) && (options_.max_gap <= 0 || now.gap <= enough_gap_) &&
         (!includes_distance() || now.gap <= enough_distance_);
}

Result<bool> FitGoals::are_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads) {
  if (!any() || balls.empty() || !may_be_met(now)) return false;
  for (const auto goal : {&FitGoals::distance_is_met, &FitGoals::error_is_met, &FitGoals::gap_is_met}) {
    Result<bool> met = (this->*goal)(now, balls, threads);
    if (!met || !met.value()) return met;
  }
  return true;
}

Result<bool> FitGoals::distance_is_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads) {
  if (!includes_distance()) return true;
  const Result<Bounds> distance =
      measure_surface_distance(solid_, balls, {.tolerance = distance_tolerance(solid_, options_), .threads = threads});
  if (!distance) return distance.error();
  const double upper = distance.value().upper;
  if (upper <= options_.max_distance) return true;
  enough_distance_ = kLessDistance * std::min(now.gap, now.gap * options_.max_distance / upper);
  return false;
}

/// The reported error of balanced balls is measured independently of the estimate by their steps.
Result<bool> FitGoals::error_is_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads) {
  if (options_.error <= 0 || options_.contract != SphereContract::kBalanced) return true;
  const Result<VolumeError> measured = estimate_volume_error(solid_, balls, {.threads = threads});
  if (!measured) return measured.error();
  const double error = measured.value().normalized();
  if (error <= options_.error) return true;
  enough_error_ = kLess * std::min(now.error, now.error * options_.error / error);
  return false;
}

Result<bool> FitGoals::gap_is_met(const Estimates& now, std::span<const Ball> balls, const Threads& threads) {
  if (options_.max_gap <= 0) return true;
  const double tolerance = kGapTolerance * options_.max_gap / solid_.diagonal();
  const Result<Bounds> gap = measure_greatest_gap(solid_, balls, {.tolerance = tolerance, .threads = threads});
  if (!gap) return gap.error();
  if (gap.value().upper <= options_.max_gap) return true;
  enough_gap_ = std::min(now.gap, now.gap * options_.max_gap / gap.value().upper);
  return false;
}

double FitGoals::share_done(const Estimates& now) const {
  double share = 1;
  if (options_.error > 0) share = std::min(share, options_.error / now.error);
  if (options_.max_gap > 0) share = std::min(share, options_.max_gap / now.gap);
  if (includes_distance()) share = std::min(share, options_.max_distance / now.gap);
  return share;
}

Error FitGoals::unmet(const Estimates& now, std::size_t balls) const {
  struct Goal {
    bool is_given;
    const char* name;
    std::string left;
  };
  const char* side = options_.contract == SphereContract::kBalanced ? "on either side" : "uncovered";
  const std::array<Goal, 3> goals = {
      {{options_.error > 0, "`error`", format_text("{:.3g} of the volume {}", now.error, side)},
       {options_.max_gap > 0, "`max_gap`", format_text("a gap of {:.3g}", now.gap)},
       {includes_distance(), "`max_distance`",
        format_text("surfaces not proved to be within {:.3g} of each other", options_.max_distance)}}};
  std::string left, names = "`count`";
  const auto last = std::find_if(goals.rbegin(), goals.rend(), [](const Goal& goal) { return goal.is_given; });
  for (const Goal& goal : goals) {
    if (!goal.is_given) continue;
    left += format_text("{}{}", left.empty() ? "" : " and ", goal.left);
    names += format_text("{}{}", &goal == &*last ? " or " : ", ", goal.name);
  }
  return {ErrorCode::kUsage,
          format_text("{} {} {}; raise {}", balls, balls == 1 ? "ball leaves" : "balls leave", left, names)};
}

}  // namespace medial_vk
