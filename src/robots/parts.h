// The solids of a robot, or of one mesh: what spheres are fitted to, each by itself.
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
  std::string link;              ///< Of a mesh by itself: its name.
  std::string name;              ///< A mesh: its file as the URDF has it, without package://; else primitiveI, from 0.
  Pose pose;                     ///< From the part's frame to its link's.
  std::optional<Ball> ball;      ///< A sphere: the part itself, in its own frame. Then there is no mesh.
  PreparedMesh mesh;             ///< In the part's frame, scaled.
  std::string file;              ///< That the mesh was read from; empty: none, or not known.
  std::optional<double> volume;  ///< Of a primitive: of the shape itself, cubic metres; not of its facets.
  double facet_share = 0;        ///< Of a curved primitive: how far the mesh is from it, as a share of the radius.
};

/// `side`: of the facets of curved primitives. Meshes are read once, however often they are used. Errors: kInvalidMesh,
/// naming the file, link and mesh; also if no link has such geometry.
Result<std::vector<Part>> load_parts(const Robot& robot, bool visual, FacetSide side, const MeshPlaces& places,
                                     const std::string& name);

/// A mesh by itself.
Part single_part(std::string name, PreparedMesh mesh);

/// The ball in the frame of the link. `grow`: by how much rounding may move it; negative to stay inside (-1), positive
/// to cover (1), 0 not at all.
Ball place(const Part& part, const Ball& ball, int grow);

}  // namespace medial_vk
