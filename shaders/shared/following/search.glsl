// The greatest ball that touches the surface at a point, by one walk of the tree: wherever a triangle is nearer to the
// centre than the sphere, the ball shrinks at once until it touches that triangle. Balls that touch at the same point lie
// in each other, so what the walk has passed over stays outside of them. Include frame.glsl and contacts.glsl before.
#ifndef MEDIAL_VK_FOLLOWING_SEARCH_GLSL
#define MEDIAL_VK_FOLLOWING_SEARCH_GLSL
#include "tree/closest_point.glsl"

// lavapipe ends all loops of an invocation silently after 65,535 iterations, and counts an iteration if any of the
// invocations beside it makes it. A round is at most kDescents nodes, kMostTests tests of triangles, and the ends of the
// three loops.
const uint kDescents = 8u;
const uint kMostTests = 12u;  // in a leaf, of at most kMostFollowLeaf triangles
#ifndef SEARCH_ROUNDS
#define SEARCH_ROUNDS 2600u
#endif

vec3 at, towards;      // the contact
bool is_fixed;         // instead: the centre stays, and the radius becomes the distance
vec3 centre;
float radius;
float slack;
float deficit;         // by which triangles are known to reach into the ball, beyond the slack
vec3 touching;         // the point that has ended the shrinking, and its triangle
uint touching_triangle;
uint rounds = 0u;      // of all searches
bool is_complete;

void place_ball() { centre = is_fixed ? centre : at + radius * towards; }

// True if the ball has shrunk, so that the triangle is to be tested once more. The test is a proof: with any vector
// `away`, no point of the triangle is nearer to the centre than the least of the three products divided by its length.
bool shrinks_at(uint triangle, bool may_repeat) {
  vec4 a = triangle_vector(4u * triangle), b = triangle_vector(4u * triangle + 1u), c = triangle_vector(4u * triangle + 2u);
  vec4 normal = triangle_vector(4u * triangle + 3u);
  TriangleTexels texels = TriangleTexels(a, vec4(b.xyz - a.xyz, b.w), vec4(c.xyz - a.xyz, c.w), normal);
  vec3 away = -vector_to_triangle(centre, texels);
  float square = dot(away, away);
  float least = min(dot(away, centre - a.xyz), min(dot(away, centre - b.xyz), dot(away, centre - c.xyz)));
  float inverse = square > 1e-30 ? inversesqrt(square) : 0.0;
  float distance = least * inverse, upper = square * inverse;
  vec3 point = centre - away;
  float through = is_fixed ? upper : radius_through(at, towards, point);
  bool meets = is_fixed ? upper < radius : !(distance >= radius - slack);
  bool shrinks = meets && (may_repeat || is_fixed) && through < radius;
  deficit = meets && !shrinks && !is_fixed ? max(deficit, radius - slack - distance) : deficit;
  radius = shrinks ? through : radius;
  touching = shrinks ? point : touching;
  touching_triangle = shrinks ? triangle : touching_triangle;
  place_ball();
  return shrinks && !is_fixed;
}

void test_leaf(uint leaf) {
  uint i = leaf & ((1u << kFollowLeafBits) - 1u), end = i + (leaf >> kFollowLeafBits), tests = 0u;
  while (i < end) {
    bool again = shrinks_at(i, tests + kMostFollowLeaf < kMostTests);
    i += again ? 0u : 1u;
    if (i >= end || ++tests == kMostTests) break;
  }
}

// From the ball that at, towards and radius (or a fixed centre) describe.
void search() {
  deficit = 0.0;
  place_ball();
  uint position = 0u, end = push.node_count;
  while (position < end) {
    uint leaf = 0u, descents = 0u;
    while (descents < kDescents) {
      uvec4 lower = node_vector(2u * position), upper = node_vector(2u * position + 1u);
      vec3 outside = max(max(uintBitsToFloat(lower.xyz) - centre, centre - uintBitsToFloat(upper.xyz)), vec3(0.0));
      bool meets = dot(outside, outside) < radius * radius;
      leaf = meets ? lower.w : 0u;
      position = meets && lower.w == 0u ? position + 1u : upper.w;
      if (leaf != 0u || position >= end || ++descents == kDescents) break;
    }
    test_leaf(leaf);
    if (position >= end || ++rounds >= SEARCH_ROUNDS) break;
  }
  is_complete = position >= end;
}

// The radius of the open ball around the centre that is proved to hold no point of the surface; 0: none.
float proved_radius() {
  float lengths = greatest_length();
  float proved = radius - slack - kDistanceRounding * lengths - deficit;
  bool is_finite = all(notEqual(floatBitsToUint(vec4(centre, radius)) & 0x7f800000u, uvec4(0x7f800000u)));
  return is_finite && is_complete && proved >= kLeastRadius * lengths ? proved : 0.0;
}

// At a contact, from the radius through another one, but from no more than `most`.
void start_at(FollowContact contact, FollowContact other, float most) {
  is_fixed = false;
  at = point_of(contact);
  towards = contact.towards.xyz;
  slack = kContactSlack * greatest_length();
  touching = point_of(other);
  touching_triangle = 0xffffffffu;
  radius = min(min(most, 0.5 * longest_side()), radius_through(at, towards, touching));
}

// After a search, as a ball with its contacts; `other` as at its start.
FollowedBall searched_ball(FollowContact contact, FollowContact other) {
  float proved = proved_radius();
  vec3 from_other = unit_or_zero(centre - touching);
  bool is_new = touching_triangle != 0xffffffffu;
  FollowContact second = other;
  if (is_new) second = contact_at(touching, touching_triangle, from_other);
  second.towards.xyz = dot(from_other, from_other) > 0.5 ? from_other : towards;
  if (!(proved > 0.0)) second = other;
  return FollowedBall(contact, second, vec4(centre, proved));
}

#endif
