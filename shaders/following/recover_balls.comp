#version 450
#extension GL_GOOGLE_include_directive : enable
// For lost balls: the greatest ball at one of their contacts, straight behind that triangle, if one is inside.
#define SEARCH_ROUNDS 640u
#define RAY_ROUNDS 1900u
#include "following/frame.glsl"
#include "following/contacts.glsl"
#include "following/search.glsl"
#include "following/ray.glsl"
#include "following/report.glsl"

void main() {
  uint index = invocation_index();
  if (index >= lists[kFollowLost]) return;
  uint ball = list_entry(kFollowLost, index);
  TrackedBall lost = load_found(ball);
  uint attempt = 0u;
  while (attempt < 2u) {
    Contact contact = lost.a;
    if (attempt == 1u) contact = lost.b;
    contact.towards = inward_normal(contact.triangle);
    bool has_area = dot(contact.towards, contact.towards) > 0.5;
    start_at(contact, contact, 1e8);
    radius = has_area ? 0.5 * longest_side() : 0.0;
    search(true);
    TrackedBall now = searched_ball(contact, contact);
    bool is_found = now.ball.w > 0.0;
    if (is_found) is_found = is_inside(now.ball.xyz);
    if (is_found) {
      report(ball, now);
      keep_state(ball, now);
    }
    attempt = is_found ? 2u : attempt + 1u;
  }
}
