// A ball: what medial spheres, unions and approximations are made of.
#pragma once

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// A ball in mesh units.
struct Ball {
  Point centre;
  double radius = 0;
};

}  // namespace medial_vk
