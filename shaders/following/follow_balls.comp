#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The first ball that is tried for each one (first_ball.glsl).
#include "lanes/lanes.glsl"
#include "following/frame.glsl"
#include "following/contacts.glsl"
#include "following/search.glsl"
#include "following/first_ball.glsl"
#include "tree_types.h"

void main() {
  bool is_wanted = invocation_index() < push.ball_count && !is_refused();
  uint ball = min(invocation_index(), push.ball_count - 1u);
  bool of_image = starts_from_rest(ball);
  start_first(ball, of_image);
  search(is_wanted);
  if (!is_wanted) return;
  if (is_complete) {
    conclude_first(ball, of_image);
  } else {
    unresolved[kUnresolvedFirst + atomicAdd(unresolved[kUnresolvedWaiting], 1u)] =
        ball | (of_image ? kFollowOfImage : 0u);
  }
}
