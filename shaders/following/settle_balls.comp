#version 450
#extension GL_GOOGLE_include_directive : enable
// The results: balls that are not known to be inside are lost, and listed to be recovered. A frame that is refused leaves
// the states as they are, or makes them those at rest.
#include "following/frame.glsl"
#include "following/contacts.glsl"
#include "following/report.glsl"

void main() {
  uint ball = invocation_index();
  if (ball >= push.ball_count) return;
  bool refused = is_refused();
  uint side = refused ? kFollowOutside : sides[ball], links = 0u;
  while (side < kFollowOutside) {
    side = sides[side];
    if (++links > kMostFollowLinks) break;
  }
  bool is_inside = side == kFollowInside;
  TrackedBall now = load_found(ball);
  now.ball.w = is_inside ? now.ball.w : 0.0;
  report(ball, now);
  if (!refused) keep_state(ball, now);
  uint copied = refused && push.from_rest != 0u ? kStateVectors : 0u;
  for (uint k = 0u; k < copied; ++k) states[kStateVectors * ball + k] = rest_vector(kRestVectors * ball + k);
  if (!refused && !is_inside) append(kFollowLost, ball);
}
