// The results of a frame. Include frame.glsl and contacts.glsl before.
#ifndef MEDIAL_VK_FOLLOWING_REPORT_GLSL
#define MEDIAL_VK_FOLLOWING_REPORT_GLSL

void report(uint ball, TrackedBall now) {
  uint index = last_of_rest(ball).w;
  balls[index] = push.inverse_scale * now.ball;
  bool is_shrunk = now.ball.w < push.shrunk * rest_radius_of(ball);
  uint state = is_shrunk ? kFollowShrunk : (squared_turn(now) < push.flat_turn ? kFollowFlat : kFollowMedial);
  ball_states[index] = now.ball.w > 0.0 ? state : kFollowIsLost;
}

// For the next frame.
void keep_state(uint ball, TrackedBall now) {
  store_state(ball, TrackedBall(keep(now.a), keep(now.b), now.ball));
}

#endif
