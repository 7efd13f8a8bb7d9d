#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The balls whose search was too long: a workgroup tests all triangles for one ball. Each invocation shrinks a ball of
// its own; the least of them has shrunk enough for all.
#include "following/frame.glsl"
#include "following/contacts.glsl"
#include "following/search.glsl"
#include "following/first_ball.glsl"
#include "tree_types.h"

const uint kMostRepeats = 2000u;  // of an invocation, beside at most 31,250 triangles

shared float radii[256];
shared float deficits[256];
shared vec3 points[256];
shared uint point_triangles[256];

void main() {
  if (workgroup_index() >= unresolved[kUnresolvedCount]) return;
  uint entry = unresolved[kUnresolvedFirst + workgroup_index()];
  uint ball = entry & ~kFollowOfImage, lane = gl_LocalInvocationID.x;
  bool of_image = (entry & kFollowOfImage) != 0u;
  start_first(ball, of_image);
  deficit = 0.0;
  place_ball();
  uint triangle = lane, repeats = 0u;
  while (triangle < push.triangle_count) {
    bool again = shrinks_at(load_followed(triangle), triangle, true, repeats < kMostRepeats);
    repeats += again ? 1u : 0u;
    triangle += again ? 0u : gl_WorkGroupSize.x;
  }
  radii[lane] = radius;
  deficits[lane] = deficit;
  points[lane] = touching;
  point_triangles[lane] = touching_triangle;
  for (uint half_count = gl_WorkGroupSize.x / 2u; half_count > 0u; half_count /= 2u) {
    barrier();
    uint other = lane + half_count;
    if (lane < half_count) {
      deficits[lane] = max(deficits[lane], deficits[other]);
      if (radii[other] < radii[lane]) {
        radii[lane] = radii[other];
        points[lane] = points[other];
        point_triangles[lane] = point_triangles[other];
      }
    }
  }
  if (lane != 0u) return;
  radius = radii[0];
  deficit = deficits[0];
  touching = points[0];
  touching_triangle = point_triangles[0];
  place_ball();
  is_complete = true;
  conclude_first(ball, of_image);
}
