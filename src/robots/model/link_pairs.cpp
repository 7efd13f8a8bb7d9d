#include "robots/model/link_pairs.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace medial_vk {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// The links next to each one across fixed joints.
std::vector<Numbers> fixed_neighbours(const Robot& robot) {
  std::vector<Numbers> next(robot.links.size());
  for (const Joint& joint : robot.joints) {
    if (joint.kind != JointKind::kFixed) continue;
    next[joint.parent].push_back(joint.child);
    next[joint.child].push_back(joint.parent);
  }
  return next;
}

/// The link itself if it has a solid, else the nearest ones with a solid that fixed joints lead to. These are trees, so
/// that only the way back leads to a link again.
Numbers solids_at(std::uint32_t link, const std::vector<Numbers>& next, const std::vector<bool>& has_solid) {
  Numbers found;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting = {{link, link}};  // and where it was reached from
  while (!waiting.empty()) {
    const auto [at, from] = waiting.back();
    waiting.pop_back();
    if (has_solid[at]) {
      found.push_back(at);
      continue;
    }
    for (const std::uint32_t other : next[at]) {
      if (other != from) waiting.emplace_back(other, at);
    }
  }
  return found;
}

}  // namespace

std::vector<std::uint32_t> rigid_links(const Robot& robot) {
  const std::vector<Numbers> next = fixed_neighbours(robot);
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> first(robot.links.size(), kNone);
  for (std::uint32_t link = 0; link < first.size(); ++link) {
    if (first[link] != kNone) continue;
    first[link] = link;
    for (Numbers waiting = {link}; !waiting.empty();) {
      const std::uint32_t at = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t other : next[at]) {
        if (first[other] != kNone) continue;
        first[other] = link;
        waiting.push_back(other);
      }
    }
  }
  return first;
}

ChosenPairs choose_pairs(const Robot& robot, const std::vector<bool>& has_solid) {
  const std::vector<Numbers> next = fixed_neighbours(robot);
  std::set<std::pair<std::uint32_t, std::uint32_t>> neighbours;
  for (const Joint& joint : robot.joints) {
    if (joint.kind == JointKind::kFixed) continue;
    const Numbers below = solids_at(joint.child, next, has_solid);
    for (const std::uint32_t a : solids_at(joint.parent, next, has_solid)) {
      for (const std::uint32_t b : below) neighbours.insert(std::minmax(a, b));
    }
  }
  const std::vector<std::uint32_t> rigid = rigid_links(robot);
  ChosenPairs chosen;
  for (std::uint32_t a = 0; a < rigid.size(); ++a) {
    for (std::uint32_t b = a + 1; b < rigid.size(); ++b) {
      if (!has_solid[a] || !has_solid[b]) continue;
      const bool is_joined = rigid[a] == rigid[b] || neighbours.contains({a, b});
      (is_joined ? chosen.joined : chosen.compared).push_back({a, b});
    }
  }
  return chosen;
}

std::vector<bool> moving_links(const Robot& robot) {
  const std::vector<std::uint32_t> rigid = rigid_links(robot);
  std::vector<bool> is_child(robot.links.size(), false);
  for (const Joint& joint : robot.joints) is_child[joint.child] = true;
  std::vector<bool> rests(robot.links.size(), false);
  for (std::size_t link = 0; link < rests.size(); ++link) {
    if (!is_child[link]) rests[rigid[link]] = true;
  }
  std::vector<bool> moves(robot.links.size());
  for (std::size_t link = 0; link < moves.size(); ++link) moves[link] = !rests[rigid[link]];
  return moves;
}

}  // namespace medial_vk
