#pragma once

#include <vector>

#include "base/internals.h"
#include "medial_vk/proximity.h"
#include "proximity/body_tree.h"

namespace medial_vk {

struct Body::Impl {
  Point centre = {0, 0, 0};  ///< The origin of the trees' frame.
  std::vector<Ball> inside, cover;
  BodyTree inside_tree, cover_tree;
};

using BodyImpl = Internals::ImplOf<Body>::Type;

}  // namespace medial_vk
