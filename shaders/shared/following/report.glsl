// The results of a frame. Include frame.glsl and contacts.glsl before.
#ifndef MEDIAL_VK_FOLLOWING_REPORT_GLSL
#define MEDIAL_VK_FOLLOWING_REPORT_GLSL

void report(uint ball, FollowedBall now) {
  uint index = rests[ball].index;
  balls[index] = push.inverse_scale * now.ball;
  bool is_shrunk = now.ball.w < push.shrunk * rests[ball].followed.ball.w;
  uint state = is_shrunk ? kFollowShrunk : (squared_turn(now) < push.flat_turn ? kFollowFlat : kFollowMedial);
  ball_states[index] = now.ball.w > 0.0 ? state : kFollowIsLost;
}

// Also for the next frame.
void settle(uint ball, FollowedBall now) {
  report(ball, now);
  states[ball] = FollowedBall(keep(now.a), keep(now.b), now.ball);
}

#endif
