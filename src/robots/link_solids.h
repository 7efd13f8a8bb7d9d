// The solids of a robot's links, as meshes and as bodies for distances.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/body_group.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/pose.h"
#include "medial_vk/prepare.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "robots/find_mesh.h"
#include "robots/model/kinematics.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// A solid that is fixed to a link.
struct LinkSolid {
  IndexedMesh mesh;
  std::uint32_t link = 0;
  Pose pose;         ///< From the frame of the mesh to that of the link.
  std::string name;  ///< That of the part (RobotParts), or the file of the mesh.
  /// Where the shape is a sphere: a ball inside the mesh, or of a solid around the shape, one that holds the mesh.
  std::optional<Ball> ball = {};
};

/// Every shape of the links between two meshes. Meshes and boxes are themselves; a cylinder, capsule or sphere has
/// facets around it and facets inside it, for lower and for upper ends of distances.
struct LinkSolids {
  std::vector<LinkSolid> around, inside;  ///< In the same order.
  /// The greatest distance of such facets from the shape, as a share of its radius; 0: both sets are the same.
  double facet_share = 0;
};

/// The collision shapes of the robot, or the visual ones. `name` is that of the URDF in messages. Errors: those of
/// load_parts().
Result<LinkSolids> load_link_solids(const Robot& robot, bool visual, const MeshPlaces& places, const std::string& name,
                                    const PrepareOptions& options);

/// Solids, and their bodies.
struct KnownBodies {
  std::span<const LinkSolid> solids;
  std::span<const GroupPart> parts;
};

/// One body for each mesh: solids with the same mesh share it, and those with a mesh of a known solid take its body.
/// Errors: those of Body::create().
Result<std::vector<GroupPart>> bodies_of(std::span<const LinkSolid> solids, unsigned threads,
                                         const KnownBodies& known = {}, const ProgressCallback& progress = {},
                                         const std::stop_token& stop = {});

/// The number of configurations that find_always_touching() tries.
inline constexpr std::size_t kTriedConfigurations = 256;

/// Those of `pairs` that touch, or are not proved free, in each of kTriedConfigurations, in which every joint has a
/// position of equal likelihood within its limits (a continuous joint: within half a turn), from a fixed seed. Errors:
/// those of BodyGroup::create() and Kinematics::place(); kInterrupted.
Result<std::vector<LinkPair>> find_always_touching(const Kinematics& kinematics, std::span<const GroupPart> parts,
                                                   std::span<const LinkPair> pairs,
                                                   const ProgressCallback& progress = {},
                                                   const std::stop_token& stop = {});

}  // namespace medial_vk
