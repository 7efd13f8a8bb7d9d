// The solids of a robot, or of one mesh, each fitted with its own spheres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"
#include "robots/find_mesh.h"
#include "robots/model/robot.h"
#include "robots/primitive_mesh.h"

namespace medial_vk {

/// One geometry of a link.
struct Part {
  std::string link;              ///< For a single mesh, its name.
  std::string name;              ///< For a mesh, its file in the URDF without package://; else primitiveI, from 0.
  Pose pose;                     ///< From the part's frame to that of its link.
  std::optional<Ball> ball;      ///< For a sphere, the part itself in its own frame. Then there is no mesh.
  PreparedMesh mesh;             ///< In the part's frame, scaled.
  std::string file;              ///< The source of the mesh; empty: none, or unknown.
  std::optional<double> volume;  ///< Of a primitive, in cubic metres: of the shape itself, not of its facets.
  double facet_share = 0;        ///< Of a curved primitive: distance of the mesh from it, as a share of the radius.
};

/// `side` applies to the facets of curved primitives. A mesh used several times is read once. Errors: kInvalidMesh,
/// naming the file, link and mesh; also if no link has such geometry.
Result<std::vector<Part>> load_parts(const Robot& robot, bool visual, FacetSide side, const MeshPlaces& places,
                                     const std::string& name);

/// A part from a single mesh.
Part single_part(std::string name, PreparedMesh mesh);

/// The ball in the frame of the link. `grow` adds the motion by rounding to the radius: -1 to stay inside, 1 to cover,
/// 0 for none.
Ball place(const Part& part, const Ball& ball, int grow);

}  // namespace medial_vk
