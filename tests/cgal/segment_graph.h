// CGAL's segment Delaunay graph, whose dual is the Voronoi diagram of points and segments.
#pragma once

#include "support/plane_axis/other_diagram.h"

namespace medial_vk::test {

/// Of the points and segments of a shape whose segments meet in common ends only, with exact predicates.
OtherDiagram cgal_diagram(const PreparedShape& shape);

}  // namespace medial_vk::test
