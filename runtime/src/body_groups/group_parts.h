// The parts of a group as its queries need them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/internals.h"
#include "medial_vk/body_group.h"
#include "proximity/body_tree.h"

namespace medial_vk {

/// By how much a rotation, whose rows are given, is known to differ from one: |R^T R - 1| as a linear map. The norm of
/// a symmetric matrix is at most three times its greatest entry, which has an error of 4 u, u = 2^-53.
double defect_of(const Pose& pose);

/// A part on its link.
struct PlacedPart {
  Ball ball;              ///< Holds the solid, in the frame of the link.
  double extent = 0;      ///< Of the pose's shift, and of the farthest point of the solid from the origin of its body.
  double defect = 0;      ///< defect_of() the pose.
  bool is_moved = false;  ///< The pose is not the identity.
};

/// A tree over the balls of the parts of a link.
struct PlacedLink {
  std::vector<std::uint32_t> parts;
  Point centre = {0, 0, 0};  ///< The origin of the tree.
  BodyTree tree;
  double extent = 0;  ///< No point of a ball of the tree is farther from the origin of the link.
};

struct BodyGroup::Impl {
  std::vector<GroupPart> parts;
  std::vector<PlacedPart> placed;  // of the parts
  std::vector<PlacedLink> links;
  std::vector<LinkPair> pairs;
  /// Those of two links with parts; the first has no fewer than the second.
  std::vector<LinkPair> compared;
  bool has_meshes = true;  // of all compared parts
};

using BodyGroupImpl = Internals::ImplOf<BodyGroup>::Type;

}  // namespace medial_vk
