#include <cmath>
#include <numbers>
#include <random>

#include "robots/link_solids.h"

namespace medial_vk {
namespace {

/// At the same place on every machine: the generator is fixed by the standard, and so is the product.
double position_within(const FreeJoint& joint, std::mt19937_64& random) {
  const double share = static_cast<double>(random() >> 11) * 0x1p-53;
  if (joint.kind == JointKind::kContinuous) return (2 * share - 1) * std::numbers::pi;
  return (1 - share) * joint.lower + share * joint.upper;
}

/// The poses of all links, configuration after configuration.
Result<std::vector<Pose>> tried_poses(const Kinematics& kinematics) {
  std::mt19937_64 random(1);
  std::vector<double> values(kinematics.joints().size());
  std::vector<Pose> poses(kTriedConfigurations * kinematics.links());
  for (std::size_t i = 0; i < kTriedConfigurations; ++i) {
    for (std::size_t j = 0; j < values.size(); ++j) values[j] = position_within(kinematics.joints()[j], random);
    const std::span<Pose> of_links = std::span(poses).subspan(i * kinematics.links(), kinematics.links());
    if (Status status = kinematics.place(values, of_links); !status) return status.error();
  }
  return poses;
}

/// True if two links are not proved free in any configuration. Where nothing is proved, because a pose is out of the
/// range of distances, they are not taken to touch.
Result<bool> always_touch(const BodyGroup& pair, std::span<const Pose> poses) {
  const std::size_t links = pair.links();
  for (std::size_t first = 0; first < poses.size(); first += links) {
    const Result<LeastDistance> distance =
        least_distance(pair, poses.subspan(first, links), {.exact = true, .tolerance = 0, .limit = 0});
    if (!distance) return distance.error();
    if (distance.value().lower > 0 || std::isinf(distance.value().upper)) return false;
  }
  return true;
}

}  // namespace

Result<std::vector<LinkPair>> find_always_touching(const Kinematics& kinematics, std::span<const GroupPart> parts,
                                                   std::span<const LinkPair> pairs, const ProgressCallback& progress,
                                                   const std::stop_token& stop) {
  const Result<std::vector<Pose>> poses = tried_poses(kinematics);
  if (!poses) return poses.error();
  std::vector<LinkPair> touching;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(pairs.size()));
    if (stop.stop_requested()) return Error{ErrorCode::kInterrupted, "interrupted"};
    std::vector<GroupPart> of_pair;
    for (const GroupPart& part : parts) {
      if (part.link == pairs[i].a || part.link == pairs[i].b) of_pair.push_back(part);
    }
    const Result<BodyGroup> pair = BodyGroup::create(of_pair, kinematics.links(), pairs.subspan(i, 1));
    if (!pair) return pair.error();
    const Result<bool> touches = always_touch(pair.value(), poses.value());
    if (!touches) return touches.error();
    if (touches.value()) touching.push_back(pairs[i]);
  }
  return touching;
}

}  // namespace medial_vk
