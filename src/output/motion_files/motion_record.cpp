#include "output/motion_files/motion_record.h"

#include <algorithm>
#include <array>
#include <limits>

namespace medial_vk {
namespace {

constexpr std::array kStatesOfBallsInside = {"medial", "flat", "shrunk", "lost"};
constexpr std::array kStatesOfCovers = {"steady", "grown", "unused"};

}  // namespace

double CoveredFrame::added_percent() const {
  // Balls that are proved to cover the surface alone may be smaller than the solid.
  if (!(measures.solid_volume > 0 && measures.added() >= 0)) return std::numeric_limits<double>::quiet_NaN();
  return 100 * measures.added() / measures.solid_volume;
}

double FollowedFrame::uncovered_percent() const {
  if (!(measures.solid_volume > 0)) return std::numeric_limits<double>::quiet_NaN();
  return 100 * measures.uncovered() / measures.solid_volume;
}

void FollowedFrame::forget_solid_volume() {
  (cover ? cover->measures.solid_volume : measures.solid_volume) = std::numeric_limits<double>::quiet_NaN();
}

std::size_t FollowedFrame::renewed() const {
  return static_cast<std::size_t>(std::ranges::count(origins, FollowOrigin::kRenewed));
}

std::span<const char* const> state_names(const MotionRecord& record) {
  if (record.covers) return kStatesOfCovers;
  return kStatesOfBallsInside;
}

std::vector<std::uint8_t> state_numbers(const FollowedFrame& frame) {
  std::vector<std::uint8_t> numbers;
  numbers.reserve(frame.balls.size());
  if (frame.cover) {
    for (const CoverBallState state : frame.cover->states) numbers.push_back(static_cast<std::uint8_t>(state));
  } else {
    for (const FollowState state : frame.states) numbers.push_back(static_cast<std::uint8_t>(state));
  }
  return numbers;
}

std::vector<std::size_t> state_counts(const MotionRecord& record, const FollowedFrame& frame) {
  std::vector<std::size_t> counts(state_names(record).size());
  for (const std::uint8_t number : state_numbers(frame)) ++counts[number];
  return counts;
}

}  // namespace medial_vk
