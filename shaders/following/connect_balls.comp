#version 450
#extension GL_GOOGLE_include_directive : enable
// A ball that overlaps its parent has the side of that; the others are listed.
#include "following/frame.glsl"

void main() {
  uint ball = invocation_index();
  if (ball >= push.ball_count || is_refused()) return;
  uint parent = last_of_rest(ball).z;
  vec4 own = found_ball(ball), other = found_ball(parent);
  vec3 between = own.xyz - other.xyz;
  float reach = own.w + other.w;
  const float kCertain = 1.0 - 16.0 * 1.1920929e-7;  // docs/theory.md, "Balls on the device"
  bool overlaps = parent != ball && own.w > 0.0 && other.w > 0.0 && dot(between, between) < kCertain * reach * reach;
  sides[ball] = overlaps ? parent : kFollowOutside;
  if (own.w > 0.0 && !overlaps) append(kFollowRays, ball);
}
