#pragma once

#include <cstdint>
#include <vector>

#include "base/internals.h"
#include "medial_vk/nearest_bodies.h"
#include "proximity/body_tree.h"

namespace medial_vk {

struct PlacedBodies::Impl {
  std::vector<PlacedBody> bodies;
  Point centre = {0, 0, 0};          ///< The origin of the tree's frame.
  BodyTree tree;                     ///< Of the balls around bodies.
  std::vector<std::size_t> of_ball;  ///< By index of a ball in the tree: its body.
  std::vector<std::size_t> unknown;  ///< Bodies of which neither mesh nor cover says how far they reach.
};

/// A ball that holds the solid of a body in its pose, with all errors. False: neither a mesh nor a cover tells.
bool world_ball_of(const PlacedBody& placed, Ball& ball);

/// No point of a body, its solid and its balls, is farther from the origin of its frame.
double reach_of_body(const Body& body);

Status check_world_pose(const Pose& pose, const std::string& whose);

}  // namespace medial_vk
