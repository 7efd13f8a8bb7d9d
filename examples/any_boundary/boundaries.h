// Boundaries that answer with nearest points: an analytic solid, a cloud of points, and an implicit surface.
#pragma once

#include <medial_vk/any_boundary.h>

namespace any_boundary {

/// A torus with circles of radius 1 and 0.4. Its nearest points are a formula.
medial_vk::BoundaryFunctions torus();

/// 5,000 points on a helix of radius 1 and four turns, in a k-d tree. Between the turns lies a helical surface. Points
/// have no inside.
medial_vk::BoundaryFunctions helix_of_points();

/// A box with rounded edges, by its signed distance function alone: an implicit surface whose function tells distances,
/// so that nearest points are found along its gradient, with an error that is stated, and wrong ones are known.
medial_vk::BoundaryFunctions rounded_box();

}  // namespace any_boundary
