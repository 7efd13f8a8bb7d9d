// How far a set of balls sticks out of its solid.
#pragma once

namespace medial_vk {

/// How far balls reach out of their solid at most, over the balls of a set; all 0 where none does.
struct ReachOut {
  double mean = 0, best = 0, worst = 0;
};

}  // namespace medial_vk
