// What `medial-vk clearance` compares: the solids of links and scene, and the pairs of links.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cli/options/clearance_options.h"
#include "medial_vk/ball.h"
#include "medial_vk/body_group.h"
#include "medial_vk/measurements.h"
#include "medial_vk/result.h"
#include "robots/link_solids.h"
#include "robots/model/kinematics.h"
#include "robots/model/robot.h"

namespace medial_vk::cli {

/// Balls of a solid, in its own frame.
struct SolidBalls {
  std::vector<Ball> inside, cover;
};

/// A robot in its surroundings. All files of the scene are one further link, after those of the robot, since a query
/// finds the near ones of many solids on a link by a tree.
struct RobotAndScene {
  Robot robot;
  LinkSolids solids;               ///< Those of the scene, one for each file, come last.
  std::vector<std::string> names;  ///< Of the owners of solids: links, then files.
  /// Of the body files of the scene, proved again, by their owners.
  std::map<std::uint32_t, SolidBalls> balls_of_files;
  std::vector<LinkPair> joined, touching;  ///< Links that are not compared, unless there is an SRDF,
  std::vector<LinkPair> from_srdf;         ///< and those that it names.
  std::vector<LinkPair> pairs;             ///< Those that are compared.

  std::size_t files() const { return names.size() - robot.links.size(); }
  std::size_t links() const { return robot.links.size() + (files() > 0 ? 1 : 0); }
  /// Whose a solid is, by its number: an index of `names`.
  std::uint32_t owner_of(std::size_t solid) const;
};

/// Reads the robot, the meshes of its links and the scene. Errors: kInvalidMesh, kUsage, kOutOfMemory, kInterrupted.
Result<RobotAndScene> load_robot_and_scene(const ClearanceOptions& options, std::vector<StageTime>& times);

/// Fills the lists of pairs. Links that joints do not move relative to the root are not compared with the scene.
/// `parts` are the bodies of solids.around. Errors: kInvalidMesh, kInterrupted.
Status find_pairs(const ClearanceOptions& options, const Kinematics& kinematics, std::span<const GroupPart> parts,
                  RobotAndScene& all, const ProgressCallback& progress, const std::stop_token& stop);

/// The SRDF of `--write-srdf`.
std::string encode_left_out(const RobotAndScene& all);

}  // namespace medial_vk::cli
