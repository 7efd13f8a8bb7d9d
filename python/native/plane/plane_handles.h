// The objects of the plane that Python holds.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/plane_shape.h"
#include "medial_vk/plane_thesis.h"

namespace medial_vk::python {

/// A prepared shape, and its boundary for queries. Immutable.
struct ShapeHandle {
  PreparedShape shape;
  PlaneBoundary boundary;
};

using SharedShape = std::shared_ptr<ShapeHandle>;

/// A medial axis, or the curves between sites, which are then here. Immutable.
struct PlaneAxisHandle {
  PlaneAxis axis;
  double longest_side = 0;  ///< Of the box of the shape or the sites.
  std::optional<PlaneSites> sites;
  std::vector<SharedShape> shapes;  ///< Sites that are shapes, whose inside belongs to them.
};

}  // namespace medial_vk::python
