#version 450
#extension GL_GOOGLE_include_directive : enable
// The share of each ball in a union of balls: the volume of the ball and the area of its sphere in its power cell, in
// units of its radius. One invocation per ball, in the order of the tree, so that neighbours run together.
#include "ball_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { BallConstants push; };
layout(set = 0, binding = 3) writeonly buffer Results { MeasuredBall results[]; };

#include "ball_unions/power_cell.glsl"
#include "ball_unions/clip_power_cell.glsl"
#include "ball_unions/ball_walk.glsl"
#include "ball_unions/ball_in_cell.glsl"

// The last cut left only points beyond the plane: the cell is empty, or a sliver of the size of the cell's
// displacement.
MeasuredBall empty_cell() {
  float moves = 2.0 * displacement();
  float sliver = beyond > moves ? 0.0 : moves;
  return MeasuredBall(0.0, 0.0, 3.1415927 * sliver, 6.2831853 * sliver);
}

void main() {
  own = push.first_ball + workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (own >= push.end_ball) return;
  own_high = balls[own].high;
  own_middle = balls[own].middle;
  own_radius = own_high.w;
  own_unit = 1.0 / own_radius;
  spent = 0u;
  if (own_radius < kLeastRadius) {
    results[own] = MeasuredBall(0.0, 0.0, -1.0, -1.0);
    return;
  }
  start_cell();
  test_hints();
  walk_balls();
  MeasuredBall found = MeasuredBall(0.0, 0.0, -1.0, -1.0);
  bool given_up = cell_failed || spent + 16u * corner_count > push.iterations;
  if (!given_up) {
    if (cell_is_empty) {
      found = empty_cell();
    } else if (is_polyhedron()) {
      found = measure_cell();
    }
  }
  results[own] = found;
}
