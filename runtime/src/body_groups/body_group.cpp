#include <algorithm>
#include <cmath>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "base/point_ops.h"
#include "body_groups/group_parts.h"
#include "proximity/pair_query.h"

namespace medial_vk {
namespace {

constexpr double kMostDefect = 1e-12;

Error part_error(std::size_t part, const char* what) {
  return {ErrorCode::kUsage, format_text("part {} of `parts` {}", part, what)};
}

double determinant_of(const Pose& pose) { return dot(pose.rotation[0], cross(pose.rotation[1], pose.rotation[2])); }

/// The ball of the body, in the frame of the link. Mapped, a centre has an error of 4 u (|centre| + |shift|) in each
/// coordinate, and lengths grow by at most the defect.
Status place(std::size_t index, const GroupPart& part, PlacedPart& placed) {
  placed.defect = defect_of(part.pose);
  if (!(placed.defect <= kMostDefect && determinant_of(part.pose) > 0)) {
    return part_error(index, "has a `pose` that is no rigid motion");
  }
  Ball ball;
  if (!find_ball_around(part.body, ball)) return part_error(index, "has a `body` with neither a mesh nor a cover");
  const double reach = length(ball.centre) + ball.radius, shift = length(part.pose.shift);
  if (!(reach + shift <= kLargestCoordinate)) return part_error(index, "reaches beyond 1e18");
  placed.is_moved = part.pose != Pose();
  placed.extent = (shift + reach) * 1.01;
  placed.ball = ball;
  if (!placed.is_moved) return {};
  placed.ball.centre = part.pose * ball.centre;
  placed.ball.radius = ball.radius * (1 + placed.defect) + 0x1p-48 * placed.extent;
  return {};
}

Status check_link(const char* list, std::size_t index, std::uint32_t link, std::size_t links) {
  if (link < links) return {};
  return Error{ErrorCode::kUsage,
               format_text("element {} of {} names link {} of {} `links`", index, list, link, links)};
}

Status check_pairs(std::span<const LinkPair> pairs, std::size_t links) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (Status status = check_link("`pairs`", i, pairs[i].a, links); !status) return status;
    if (Status status = check_link("`pairs`", i, pairs[i].b, links); !status) return status;
    if (pairs[i].a != pairs[i].b) continue;
    return Error{ErrorCode::kUsage, format_text("element {} of `pairs` is link {} and itself", i, pairs[i].a)};
  }
  return {};
}

void build_tree(const std::vector<PlacedPart>& placed, PlacedLink& link) {
  if (link.parts.empty()) return;
  std::vector<Ball> balls;
  Point lower = placed[link.parts.front()].ball.centre, upper = lower;
  for (const std::uint32_t part : link.parts) {
    balls.push_back(placed[part].ball);
    lower = least(lower, balls.back().centre);
    upper = greatest(upper, balls.back().centre);
  }
  link.centre = 0.5 * (lower + upper);
  link.tree = BodyTree::build(balls, link.centre);
  link.extent = 1.01 * (link.tree.nodes().reach() + length(link.centre));
}

}  // namespace

double defect_of(const Pose& pose) {
  const auto& r = pose.rotation;
  double greatest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double off = std::fabs(dot(r[i], r[j]) - (i == j ? 1 : 0));
      if (!(off <= greatest)) greatest = off;  // also where it is no number
    }
  }
  return 3 * (greatest + 4 * 0x1p-53);
}

Result<BodyGroup> BodyGroup::create(std::span<const GroupPart> parts, std::size_t links,
                                    std::span<const LinkPair> pairs) {
  if (Status status = check_pairs(pairs, links); !status) return status.error();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (Status status = check_link("`parts`", i, parts[i].link, links); !status) return status.error();
  }
  return catch_out_of_memory("indexing a group of bodies", [&]() -> Result<BodyGroup> {
    auto impl = std::make_shared<Impl>();
    impl->parts.assign(parts.begin(), parts.end());
    impl->placed.resize(parts.size());
    impl->links.resize(links);
    impl->pairs.assign(pairs.begin(), pairs.end());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (Status status = place(i, parts[i], impl->placed[i]); !status) return status.error();
      impl->links[parts[i].link].parts.push_back(static_cast<std::uint32_t>(i));
      impl->has_meshes = impl->has_meshes && parts[i].body.has_mesh();
    }
    for (PlacedLink& link : impl->links) build_tree(impl->placed, link);
    for (const LinkPair& pair : pairs) {
      const std::size_t of_a = impl->links[pair.a].parts.size(), of_b = impl->links[pair.b].parts.size();
      if (of_a == 0 || of_b == 0) continue;
      impl->compared.push_back(of_a >= of_b ? pair : LinkPair{pair.b, pair.a});
    }
    return BodyGroup(impl);
  });
}

std::size_t BodyGroup::links() const { return impl_->links.size(); }
std::span<const GroupPart> BodyGroup::parts() const { return impl_->parts; }
std::span<const LinkPair> BodyGroup::pairs() const { return impl_->pairs; }

}  // namespace medial_vk
