#version 450
#extension GL_GOOGLE_include_directive : enable
// The sides of balls by rays from their centres.
#include "following/frame.glsl"
#include "following/ray.glsl"

void main() {
  uint index = invocation_index();
  if (index >= lists[kFollowRays]) return;
  uint ball = list_entry(kFollowRays, index);
  sides[ball] = is_inside(found_ball(ball).xyz) ? kFollowInside : kFollowOutside;
}
