// Box, cylinder, capsule and sphere as triangle meshes that keep a contract: inside the shape, or around it.
#pragma once

#include "medial_vk/mesh.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// The side of a curved wall on which its facets lie.
enum class FacetSide {
  kInscribed,      ///< The mesh is inside the shape, for balls that must not reach out of it.
  kCircumscribed,  ///< The shape is inside the mesh, for balls that must cover it.
};

/// Sides of the polygon that approximates a circle, and rings of facets of a hemisphere.
inline constexpr std::uint32_t kCircleSides = 96;
inline constexpr std::uint32_t kCapRings = 24;

/// The greatest distance between mesh and shape as a share of the radius: 1 - cos(pi/96) = 5.4e-4 for a cylinder; for a
/// capsule 1 - cos(pi/96) cos(pi/96) = 1.1e-3. Circumscribed meshes are 1/(1 - share) - 1 outside. A box is exact.
double facet_share(GeometryKind kind);

/// A closed mesh of a box, cylinder, capsule or sphere in its own frame, inside or around it for any rounding. The mesh
/// of a sphere is as far from it as that of a capsule from its caps.
Mesh make_primitive(const Geometry& geometry, FacetSide side);

/// The volume of the shape itself, also of a sphere, in cubic metres. 0 for a mesh.
double primitive_volume(const Geometry& geometry);

}  // namespace medial_vk
