// The first ball that is tried for each one: its image from the rest pose where both contacts have moved as there, else
// the ball that keeps a contact. Include contacts.glsl and search.glsl before.
#ifndef MEDIAL_VK_FOLLOWING_FIRST_BALL_GLSL
#define MEDIAL_VK_FOLLOWING_FIRST_BALL_GLSL

const float kNoLongerRest = 0.001;    // a change of the radius and of the cosine between both directions
const float kFlatTurn = 0.6650743;  // squared_turn() at an object angle of 0.42
const float kShrunkNow = 0.8;         // of the last radius

// At rest, or after the last frame.
TrackedBall load_last(uint ball, bool at_rest) {
  uvec4 vectors[kStateVectors];
  [[unroll]] for (uint k = 0u; k < kStateVectors; ++k) {
    uvec4 rest = rest_vector(kRestVectors * ball + k), last = state_vector(kStateVectors * ball + k);
    vectors[k] = at_rest ? rest : last;
  }
  return unpacked(vectors[0], vectors[1], vectors[2], vectors[3], vectors[4], vectors[5]);
}

TrackedBall contacts_tried;
float last_radius, rest_radius;

// Prepares a search.
void start_first(uint ball, bool of_image) {
  bool from_rest = push.from_rest != 0u;
  rest_radius = rest_radius_of(ball);
  float state_radius = uintBitsToFloat(state_vector(kStateVectors * ball + 3u).w);
  last_radius = from_rest ? rest_radius : state_radius;
  TrackedBall last = load_last(ball, of_image || from_rest);
  last.a = carry(last.a);
  last.b = carry(last.b);
  // First the contact that stays, within a face, if one is.
  contacts_tried = last;
  if (!of_image && !is_within_face(last.a) && is_within_face(last.b)) {
    contacts_tried.a = last.b;
    contacts_tried.b = last.a;
  }
  start_at(contacts_tried.a, contacts_tried.b, of_image ? rest_radius + kContactSlack * greatest_length() : 1e8);
}

bool starts_from_rest(uint ball) {
  TrackedBall rest = load_rest(ball);
  vec2 at_rest = uintBitsToFloat(last_of_rest(ball).xy);  // FollowRest::through and turn
  Contact a = carry(rest.a), b = carry(rest.b);
  float through = radius_through(point_of(a), a.towards, point_of(b));
  float turn = dot(a.towards, b.towards) - at_rest.y;
  return abs(through / at_rest.x - 1.0) + abs(turn) < kNoLongerRest;
}

bool is_too_small(TrackedBall now) {
  return squared_turn(now) < kFlatTurn || now.ball.w < kShrunkNow * last_radius;
}

// Stores the ball of the search, and whether others are to be tried.
void conclude_first(uint ball, bool of_image) {
  TrackedBall now = searched_ball(contacts_tried.a, contacts_tried.b);
  store_found(ball, now);
  float lost_to_rounding = 2.0 * (kContactSlack + kDistanceRounding) * greatest_length();
  bool is_whole = now.ball.w >= (1.0 - kNoLongerRest) * rest_radius - lost_to_rounding;
  bool again = of_image ? !is_whole : is_too_small(now);
  if (again) append(kFollowAgain, ball | (of_image ? kFollowOfImage : 0u));
}

#endif
