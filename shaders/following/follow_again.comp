#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Other balls for those whose first one is small or no longer medial: where an image from the rest pose does not fit, the
// ball that keeps a contact; then the one between both contacts, around the point that lies as far from both along their
// directions. The greatest stays.
#include "lanes/lanes.glsl"
#include "following/frame.glsl"
#include "following/contacts.glsl"
#include "following/search.glsl"
#include "following/first_ball.glsl"

const uint kKeepContact = 0u, kFindNearest = 1u, kTouchNearest = 2u, kEnd = 3u;

// The point from which `nearest` is sought; false: there is none.
bool start_between(Contact a, Contact b) {
  vec3 at_a = point_of(a), at_b = point_of(b);
  vec3 turn = a.towards - b.towards;
  float square = dot(turn, turn), along = square > 1e-12 ? dot(at_b - at_a, turn) / square : 0.0;
  centre = 0.5 * ((at_a + along * a.towards) + (at_b + along * b.towards));
  radius = 1.00001 * min(distance(centre, at_a), distance(centre, at_b));
  is_fixed = true;
  touching_triangle = 0xffffffffu;
  return along > 0.0 && radius < 1e8;
}

// At the point that was found; false: it is too near, or the guess is outside, as far as the normal tells. A proved radius
// is less than that of its search by more than `slack`, so that the search ends where none above `least` can follow.
bool touch_nearest(inout TrackedBall tried, float least) {
  if (touching_triangle == 0xffffffffu || !is_complete) return false;
  vec3 guess = centre;
  vec3 away = guess - touching;
  Contact nearest = contact_at(touching, touching_triangle, unit_or_zero(away));
  vec3 to_a = point_of(tried.a) - guess, to_b = point_of(tried.b) - guess;
  if (dot(to_a, to_a) > dot(to_b, to_b)) tried.b = tried.a;
  tried.a = nearest;
  start_at(tried.a, tried.b, 1e8);
  least_wanted = least + slack;
  return length(away) > 2.0 * slack && dot(nearest.towards, inward_normal(nearest.triangle)) > 0.0;
}

void main() {
  uint index = invocation_index();
  bool is_listed = index < lists[kFollowAgain];
  uint entry = list_entry(kFollowAgain, min(index, push.ball_count - 1u));
  uint ball = is_listed ? entry & ~kFollowOfImage : 0u;
  bool of_image = (entry & kFollowOfImage) != 0u;
  start_first(ball, false);
  TrackedBall best = load_found(ball), tried = contacts_tried;
  bool goes_on = is_listed;
  uint stage = kKeepContact;
  while (stage < kEnd) {
    if (stage == kFindNearest) goes_on = goes_on && is_too_small(best) && start_between(contacts_tried.a, contacts_tried.b);
    if (stage == kTouchNearest) goes_on = goes_on && touch_nearest(tried, best.ball.w);
    bool is_searched = goes_on && (stage != kKeepContact || of_image);
    search(is_searched);
    if (is_searched && stage != kFindNearest) {
      TrackedBall now = searched_ball(tried.a, tried.b);
      if (now.ball.w > best.ball.w) best = now;
    }
    if (++stage == kEnd) break;
  }
  if (!is_listed) return;
  // A ball that is lost keeps the contacts that it had.
  if (!(best.ball.w > 0.0)) best = TrackedBall(contacts_tried.a, contacts_tried.b, best.ball);
  store_found(ball, best);
}
