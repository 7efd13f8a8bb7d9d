#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/internals.h"
#include "medial_vk/proximity.h"
#include "proximity/body_tree.h"
#include "proximity/large_balls.h"
#include "proximity/mean_errors.h"
#include "proximity/surface_tree.h"
#include "solid/solid.h"

namespace medial_vk {

/// The surface of a body.
struct BodySurface {
  Solid solid;
  SurfaceTree tree;
  /// Of each component of the mesh, the corners that are farthest along and against each axis.
  std::vector<std::array<Point, 6>> extremes;

  BodySurface(Solid of_mesh, const Point& centre, unsigned threads, LoopWatch& watch);
};

struct Body::Impl {
  Point centre = {0, 0, 0};  ///< The origin of the trees' frame.
  std::vector<Ball> inside, cover;
  BodyTree inside_tree, cover_tree;
  LargeBalls large_inside;
  std::unique_ptr<const BodySurface> surface;  ///< Null: without a mesh.
  MeanErrors errors;                           ///< Known with a mesh and both sets.
};

using BodyImpl = Internals::ImplOf<Body>::Type;

}  // namespace medial_vk
