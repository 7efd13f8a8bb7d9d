#version 450
#extension GL_GOOGLE_include_directive : enable
// The first ball that is tried for each one (first_ball.glsl).
#include "following/frame.glsl"
#include "following/contacts.glsl"
#include "following/search.glsl"
#include "following/first_ball.glsl"
#include "tree_types.h"

void main() {
  uint ball = invocation_index();
  if (ball >= push.ball_count || is_refused()) return;
  bool of_image = starts_from_rest(ball);
  start_first(ball, of_image);
  search();
  if (is_complete) {
    conclude_first(ball, of_image);
  } else {
    unresolved[kUnresolvedFirst + atomicAdd(unresolved[kUnresolvedWaiting], 1u)] =
        ball | (of_image ? kFollowOfImage : 0u);
  }
}
