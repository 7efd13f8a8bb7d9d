// The solids of a robot as parts that can be fitted.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/part_fits.h"
#include "medial_vk/prepare.h"
#include "robots/find_mesh.h"
#include "robots/model/robot.h"
#include "robots/primitive_mesh.h"

namespace medial_vk {

struct PartOrigin {
  std::string file;        ///< Of the mesh; empty: the part is a primitive.
  double facet_share = 0;  ///< Of a curved primitive: distance of the mesh from it, as a share of the radius.
};

/// The geometries of a robot. The name of a part is its file in the URDF without package://, or primitiveI, from 0.
struct RobotParts {
  std::vector<Part> parts;          ///< Those of a link are consecutive.
  std::vector<PartOrigin> origins;  ///< In the same order.
};

/// `side` applies to the facets of curved primitives. A mesh used several times is read once, and indexed once for each
/// scale. `options`: as in prepare_mesh(). Errors: kInvalidMesh, naming the file, link and mesh; also if no link has
/// such geometry.
Result<RobotParts> load_parts(const Robot& robot, bool visual, FacetSide side, const MeshPlaces& places,
                              const std::string& name, const PrepareOptions& options = {});

}  // namespace medial_vk
