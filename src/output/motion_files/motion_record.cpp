#include "output/motion_files/motion_record.h"

#include <algorithm>
#include <limits>

namespace medial_vk {

double FollowedFrame::uncovered_percent() const {
  if (!(measures.solid_volume > 0)) return std::numeric_limits<double>::quiet_NaN();
  return 100 * measures.uncovered() / measures.solid_volume;
}

std::size_t FollowedFrame::renewed() const {
  return static_cast<std::size_t>(std::ranges::count(origins, FollowOrigin::kRenewed));
}

const char* name_of(FollowState state) {
  switch (state) {
    case FollowState::kMedial:
      return "medial";
    case FollowState::kFlat:
      return "flat";
    case FollowState::kShrunk:
      return "shrunk";
    case FollowState::kLost:
      break;
  }
  return "lost";
}

}  // namespace medial_vk
