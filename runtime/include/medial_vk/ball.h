// A ball: the element of medial spheres, unions and approximations.
#pragma once

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// A ball in mesh units.
struct Ball {
  Point centre;
  double radius = 0;
};

}  // namespace medial_vk
