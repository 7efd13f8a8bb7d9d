// The rule of Section 7.4.1: one contact, interpolated normals, Algorithm 5.
#pragma once

#include <span>
#include <vector>

#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"

namespace medial_vk {

/// The inward unit normal of each vertex: the mean of its triangles, by area; 0 where they cancel out. Replaces
/// `normals`, which has one element per vertex.
void find_vertex_normals(const MovingSurface& surface, std::vector<Point>& normals);

/// Algorithm 5: the radius of the ball that touches the surface at `at`, with the centre along the unit vector
/// `towards_centre`, and reaches out of it by at most `protrusion`, which is positive, or by a rounding; from the ball
/// of this radius.
double shrink(const MovingSurface& surface, const Point& at, const Point& towards_centre, double radius,
              double protrusion);

/// The ball in the present frame, from that in the rest pose, by the contact `a` and the normals of its corners. Radius
/// 0: its centre would be outside.
TrackedBall follow_published(const MovingSurface& surface, std::span<const Point> vertex_normals,
                             const TrackedBall& rest, double protrusion);

}  // namespace medial_vk
