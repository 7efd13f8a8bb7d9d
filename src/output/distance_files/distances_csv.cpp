#include "output/distance_files/distances_csv.h"

#include <fmt/format.h>

namespace medial_vk {

const char* name_of(Collision collision) {
  switch (collision) {
    case Collision::kFree:
      return "free";
    case Collision::kHit:
      return "hit";
    case Collision::kUndecided:
      break;
  }
  return "undecided";
}

std::string encode_distances_csv(std::span<const Distance> distances) {
  std::string csv = "lower,upper,state,ax,ay,az,bx,by,bz\n";
  for (const Distance& d : distances) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", d.lower, d.upper, name_of(d.collision()), d.on_a[0], d.on_a[1],
                       d.on_a[2], d.on_b[0], d.on_b[1], d.on_b[2]);
  }
  return csv;
}

}  // namespace medial_vk
