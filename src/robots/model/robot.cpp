#include "robots/model/robot.h"

#include <optional>

namespace medial_vk {

std::vector<Pose> link_poses(const Robot& robot) {
  std::vector<const Joint*> above(robot.links.size(), nullptr);
  for (const Joint& joint : robot.joints) above[joint.child] = &joint;
  std::vector<std::optional<Pose>> known(robot.links.size());
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t link = 0; link < robot.links.size(); ++link) {
    // Up to a link whose pose is known, then down again, without recursion, as chains may be long.
    std::uint32_t at = link;
    while (!known[at] && above[at] != nullptr) {
      waiting.push_back(at);
      at = above[at]->parent;
    }
    if (!known[at]) known[at] = Pose();
    for (; !waiting.empty(); waiting.pop_back()) {
      const Joint& joint = *above[waiting.back()];
      known[waiting.back()] = *known[joint.parent] * joint.origin;
    }
  }
  std::vector<Pose> poses;
  poses.reserve(known.size());
  for (const std::optional<Pose>& pose : known) poses.push_back(*pose);
  return poses;
}

}  // namespace medial_vk
