// Which links of a robot can collide with each other.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/body_group.h"
#include "medial_vk/result.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// For each link, the first link to which it is joined by fixed joints alone, or itself. Links with the same one never
/// move relative to each other.
std::vector<std::uint32_t> rigid_links(const Robot& robot);

/// Pairs of links, a < b, sorted.
struct ChosenPairs {
  std::vector<LinkPair> compared;
  /// Links that never move relative to each other, and links that are joined by a joint; links without a solid on the
  /// way to it that are joined by fixed joints count as a part of it.
  std::vector<LinkPair> joined;
};

/// All pairs of different links that have a solid, divided in two.
ChosenPairs choose_pairs(const Robot& robot, const std::vector<bool>& has_solid);

/// For each link: true if joints can move it relative to the root of its tree, that is, if one that is not fixed lies
/// between them.
std::vector<bool> moving_links(const Robot& robot);

/// The pairs of an SRDF, <disable_collisions link1 link2>, a < b, sorted, without repetition. Other elements are not
/// examined. Errors: kInvalidMesh with name and line: no XML, no robot, a pair with an unknown link or twice the same.
Result<std::vector<LinkPair>> read_srdf(std::string_view bytes, const std::string& name, const Robot& robot);

/// Pairs with the reason for leaving them out.
struct ReasonedPairs {
  const char* reason;
  std::span<const LinkPair> pairs;
};

/// An SRDF that read_srdf() reads.
std::string encode_srdf(const Robot& robot, std::span<const ReasonedPairs> left_out);

}  // namespace medial_vk
