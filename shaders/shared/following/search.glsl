// The greatest ball that touches the surface at a point, by one walk of the tree: wherever a triangle is nearer to the
// centre than the sphere, the ball shrinks at once until it touches that triangle. Balls that touch at the same point lie
// in each other, so what the walk has passed over stays outside of them. With LOCKSTEP, eight lanes call search()
// together. Include frame.glsl and contacts.glsl before, and lanes.glsl first if LOCKSTEP may be defined.
#ifndef MEDIAL_VK_FOLLOWING_SEARCH_GLSL
#define MEDIAL_VK_FOLLOWING_SEARCH_GLSL
#include "tree/closest_point.glsl"

vec3 at, towards;      // the contact
bool is_fixed;         // instead: the centre stays, and the radius becomes the distance
vec3 centre;
float radius;
float slack;
float deficit;         // by which triangles are known to reach into the ball, beyond the slack
vec3 touching;         // the point that has ended the shrinking, and its triangle
uint touching_triangle;
bool is_complete;
float least_wanted = -1.0;  // a search may end once its radius is not more: the ball is of no use then

void place_ball() { centre = is_fixed ? centre : at + radius * towards; }

struct FollowTriangle {
  vec4 a, b, c, normal;
};
FollowTriangle load_followed(uint triangle) {
  return FollowTriangle(triangle_vector(4u * triangle), triangle_vector(4u * triangle + 1u),
                        triangle_vector(4u * triangle + 2u), triangle_vector(4u * triangle + 3u));
}

// True if the ball has shrunk, so that the triangle is to be tested once more. The test is a proof: with any vector
// `away`, no point of the triangle is nearer to the centre than the least of the three products divided by its length.
bool shrinks_at(FollowTriangle t, uint triangle, bool is_tested, bool may_repeat) {
  TriangleTexels texels = TriangleTexels(t.a, vec4(t.b.xyz - t.a.xyz, t.b.w), vec4(t.c.xyz - t.a.xyz, t.c.w), t.normal);
  vec3 away = -vector_to_triangle(centre, texels);
  float square = dot(away, away);
  float least = min(dot(away, centre - t.a.xyz), min(dot(away, centre - t.b.xyz), dot(away, centre - t.c.xyz)));
  float inverse = square > 1e-30 ? inversesqrt(square) : 0.0;
  float distance = least * inverse, upper = square * inverse;
  vec3 point = centre - away;
  float through = is_fixed ? upper : radius_through(at, towards, point);
  bool is_near = is_fixed ? upper < radius : !(distance >= radius - slack), meets = is_tested && is_near;
  bool shrinks = meets && (may_repeat || is_fixed) && through < radius;
  deficit = meets && !shrinks && !is_fixed ? max(deficit, radius - slack - distance) : deficit;
  radius = shrinks ? through : radius;
  touching = shrinks ? point : touching;
  touching_triangle = shrinks ? triangle : touching_triangle;
  place_ball();
  return shrinks && !is_fixed;
}

#ifdef LOCKSTEP
#include "following/walk_together.glsl"
#else
#include "following/walk_alone.glsl"
#endif

// The radius of the open ball around the centre that is proved to hold no point of the surface; 0: none.
float proved_radius() {
  float lengths = greatest_length();
  float proved = radius - slack - kDistanceRounding * lengths - deficit;
  bool is_finite = all(notEqual(floatBitsToUint(vec4(centre, radius)) & 0x7f800000u, uvec4(0x7f800000u)));
  return is_finite && is_complete && proved >= kLeastRadius * lengths ? proved : 0.0;
}

// At a contact, from the radius through another one, but from no more than `most`.
void start_at(Contact contact, Contact other, float most) {
  is_fixed = false;
  at = point_of(contact);
  towards = contact.towards;
  slack = kContactSlack * greatest_length();
  touching = point_of(other);
  touching_triangle = 0xffffffffu;
  radius = min(min(most, 0.5 * longest_side()), radius_through(at, towards, touching));
}

// After a search, as a ball with its contacts; `other` as at its start.
TrackedBall searched_ball(Contact contact, Contact other) {
  float proved = proved_radius();
  vec3 from_other = unit_or_zero(centre - touching);
  bool is_new = touching_triangle != 0xffffffffu;
  Contact second = other;
  if (is_new) second = contact_at(touching, touching_triangle, from_other);
  second.towards = dot(from_other, from_other) > 0.5 ? from_other : towards;
  if (!(proved > 0.0)) second = other;
  return TrackedBall(contact, second, vec4(centre, proved));
}

#endif
