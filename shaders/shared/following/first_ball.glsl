// The first ball that is tried for each one: its image from the rest pose where both contacts have moved as there, else
// the ball that keeps a contact. Include contacts.glsl and search.glsl before.
#ifndef MEDIAL_VK_FOLLOWING_FIRST_BALL_GLSL
#define MEDIAL_VK_FOLLOWING_FIRST_BALL_GLSL

const float kNoLongerRest = 0.001;    // a change of the radius and of the cosine between both directions
const float kMedialTurn = 0.9193954;  // squared_turn() at an object angle of 0.5
const float kShrunkNow = 0.8;         // of the last radius

FollowedBall last_ball(uint ball) {
  if (push.from_rest != 0u) return rests[ball].followed;
  return states[ball];
}

// Both contacts in this frame; first the one that stays, within a face, if one is.
FollowedBall carried_ball(FollowedBall last) {
  FollowContact a = carry(last.a), b = carry(last.b);
  bool swaps = !is_within_face(a) && is_within_face(b);
  if (swaps) return FollowedBall(b, a, last.ball);
  return FollowedBall(a, b, last.ball);
}

bool is_as_at_rest(FollowRest rest, FollowContact a, FollowContact b) {
  float through = radius_through(point_of(a), a.towards.xyz, point_of(b));
  float turn = dot(a.towards.xyz, b.towards.xyz) - rest.turn;
  return abs(through / rest.through - 1.0) + abs(turn) < kNoLongerRest;
}

FollowedBall contacts_tried;
float last_radius, rest_radius;

// Prepares a search.
void start_first(uint ball, bool of_image) {
  FollowedBall last = last_ball(ball);
  last_radius = last.ball.w;
  rest_radius = rests[ball].followed.ball.w;
  float most = 1e8;
  if (of_image) {
    last = rests[ball].followed;
    contacts_tried = FollowedBall(carry(last.a), carry(last.b), last.ball);
    most = rest_radius + kContactSlack * greatest_length();
  } else {
    contacts_tried = carried_ball(last);
  }
  start_at(contacts_tried.a, contacts_tried.b, most);
}

bool starts_from_rest(uint ball) {
  FollowRest rest = rests[ball];
  return is_as_at_rest(rest, carry(rest.followed.a), carry(rest.followed.b));
}

bool is_too_small(FollowedBall now) {
  return squared_turn(now) < kMedialTurn || now.ball.w < kShrunkNow * last_radius;
}

// Stores the ball of the search, and whether others are to be tried.
void conclude_first(uint ball, bool of_image) {
  FollowedBall now = searched_ball(contacts_tried.a, contacts_tried.b);
  found[ball] = now;
  float lost_to_rounding = 2.0 * (kContactSlack + kDistanceRounding) * greatest_length();
  bool is_whole = now.ball.w >= (1.0 - kNoLongerRest) * rest_radius - lost_to_rounding;
  bool again = of_image ? !is_whole : is_too_small(now);
  if (again) append(kFollowAgain, ball | (of_image ? kFollowOfImage : 0u));
}

#endif
