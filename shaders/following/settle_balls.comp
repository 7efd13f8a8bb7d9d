#version 450
#extension GL_GOOGLE_include_directive : enable
// The results: balls that are not known to be inside are lost, and listed to be recovered.
#include "following/frame.glsl"
#include "following/contacts.glsl"
#include "following/report.glsl"

void main() {
  uint ball = invocation_index();
  if (ball >= push.ball_count) return;
  if (is_refused()) {
    FollowedBall last;
    if (push.from_rest != 0u) {
      last = rests[ball].followed;
    } else {
      last = states[ball];
    }
    states[ball] = last;
    last.ball.w = 0.0;
    report(ball, last);
    return;
  }
  uint side = sides[ball], links = 0u;
  while (side < kFollowOutside) {
    side = sides[side];
    if (++links > kMostFollowLinks) break;
  }
  FollowedBall now = found[ball];
  now.ball.w = side == kFollowInside ? now.ball.w : 0.0;
  settle(ball, now);
  if (side != kFollowInside) append(kFollowLost, ball);
}
