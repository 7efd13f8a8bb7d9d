// Contacts that move with their triangles. Include frame.glsl before.
#ifndef MEDIAL_VK_FOLLOWING_CONTACTS_GLSL
#define MEDIAL_VK_FOLLOWING_CONTACTS_GLSL

struct Contact {
  vec3 towards;  // unit vector to the centre
  vec4 carried;  // FollowState
  uint triangle;
  float v, w;
};
struct TrackedBall {
  Contact a, b;
  vec4 ball;
};

TrackedBall unpacked(uvec4 a, uvec4 b, uvec4 triangles, uvec4 ball, uvec4 carried_a, uvec4 carried_b) {
  vec4 towards_a = uintBitsToFloat(a), towards_b = uintBitsToFloat(b), places = uintBitsToFloat(triangles);
  return TrackedBall(Contact(towards_a.xyz, uintBitsToFloat(carried_a), triangles.x, towards_a.w, places.y),
                     Contact(towards_b.xyz, uintBitsToFloat(carried_b), triangles.z, towards_b.w, places.w),
                     uintBitsToFloat(ball));
}
TrackedBall load_rest(uint ball) {
  uint i = kRestVectors * ball;
  return unpacked(rest_vector(i), rest_vector(i + 1u), rest_vector(i + 2u), rest_vector(i + 3u), rest_vector(i + 4u),
                  rest_vector(i + 5u));
}
TrackedBall load_state(uint ball) {
  uint i = kStateVectors * ball;
  return unpacked(state_vector(i), state_vector(i + 1u), state_vector(i + 2u), state_vector(i + 3u),
                  state_vector(i + 4u), state_vector(i + 5u));
}
// Nothing is carried yet.
TrackedBall load_found(uint ball) {
  uint i = kFollowedVectors * ball;
  return unpacked(found_vector(i), found_vector(i + 1u), found_vector(i + 2u), found_vector(i + 3u), uvec4(0u),
                  uvec4(0u));
}

uvec4 packed_direction(Contact contact) { return floatBitsToUint(vec4(contact.towards, contact.v)); }
uvec4 packed_triangles(TrackedBall ball) {
  return uvec4(ball.a.triangle, floatBitsToUint(ball.a.w), ball.b.triangle, floatBitsToUint(ball.b.w));
}
void store_found(uint ball, TrackedBall now) {
  uint i = kFollowedVectors * ball;
  found[i] = packed_direction(now.a);
  found[i + 1u] = packed_direction(now.b);
  found[i + 2u] = packed_triangles(now);
  found[i + 3u] = floatBitsToUint(now.ball);
}
void store_state(uint ball, TrackedBall now) {
  uint i = kStateVectors * ball;
  states[i] = packed_direction(now.a);
  states[i + 1u] = packed_direction(now.b);
  states[i + 2u] = packed_triangles(now);
  states[i + 3u] = floatBitsToUint(now.ball);
  states[i + 4u] = floatBitsToUint(now.a.carried);
  states[i + 5u] = floatBitsToUint(now.b.carried);
}

vec3 point_of(Contact contact) {
  Corners t = corners_of(contact.triangle);
  return t.a + (contact.v * (t.b - t.a) + contact.w * (t.c - t.a));
}

bool is_within_face(Contact contact) {
  return contact.v > 1e-6 && contact.w > 1e-6 && contact.v + contact.w < 1.0 - 1e-6;
}

// The vectors dual to the edges from corner 0.
struct DualEdges {
  vec3 ab, ac;
};
DualEdges dual_edges(Corners t, vec3 inward) {
  vec3 ab = t.b - t.a, ac = t.c - t.a;
  vec3 over_ab = cross(inward, ac), over_ac = cross(ab, inward);
  float size = dot(over_ab, ab);
  float inverse = abs(size) > 1e-30 ? 1.0 / size : 0.0;
  return DualEdges(inverse * over_ab, inverse * over_ac);
}

// With the direction in this frame: the image under F^-T of that in the frame to which `carried` belongs.
Contact carry(Contact contact) {
  vec3 inward = inward_normal(contact.triangle);
  DualEdges dual = dual_edges(corners_of(contact.triangle), inward);
  vec3 image = unit_or_zero(contact.carried.x * dual.ab + contact.carried.y * dual.ac + contact.carried.z * inward);
  bool is_carried = contact.carried.w == 1.0 && dot(inward, inward) > 0.5 && dot(image, image) > 0.5;
  contact.towards = is_carried ? image : contact.towards;
  return contact;
}

// With what the next frame needs of this one.
Contact keep(Contact contact) {
  vec3 inward = inward_normal(contact.triangle);
  Corners t = corners_of(contact.triangle);
  vec3 d = contact.towards;
  contact.carried = vec4(dot(d, t.b - t.a), dot(d, t.c - t.a), dot(d, inward), dot(inward, inward) > 0.5 ? 1.0 : 0.0);
  return contact;
}

// The share of the way along `side` at which `offset` from its start lies.
float share_along(vec3 offset, vec3 side) {
  float square = dot(side, side);
  return square > 1e-30 ? clamp(dot(offset, side) / square, 0.0, 1.0) : 0.0;
}

// A point of a triangle, up to rounding. Without an area the triangle does not leave its longest side.
Contact contact_at(vec3 point, uint triangle, vec3 towards) {
  Corners t = corners_of(triangle);
  vec3 inward = inward_normal(triangle), offset = point - t.a;
  vec3 ab = t.b - t.a, ac = t.c - t.a, bc = t.c - t.b;
  DualEdges dual = dual_edges(t, inward);
  float v = clamp(dot(offset, dual.ab), 0.0, 1.0);
  vec2 shares = vec2(v, clamp(dot(offset, dual.ac), 0.0, 1.0 - v));
  if (!(dot(inward, inward) > 0.5)) {
    float ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc), along_bc = share_along(point - t.b, bc);
    bool is_ab = ab2 >= ac2 && ab2 >= bc2, is_ac = ac2 >= bc2;
    shares = is_ab ? vec2(share_along(offset, ab), 0.0)
                   : (is_ac ? vec2(0.0, share_along(offset, ac)) : vec2(1.0 - along_bc, along_bc));
  }
  return Contact(towards, vec4(0.0), triangle, shares.x, shares.y);
}

// The radius of the ball that touches `at` with its centre along `towards`, and passes through `other`; a large number,
// if that lies on the other side.
float radius_through(vec3 at, vec3 towards, vec3 other) {
  vec3 w = other - at;
  float along = dot(towards, w), square = dot(w, w);
  return along > 1e-30 && square < 1e8 * along ? square / (2.0 * along) : 1e8;
}

// By both directions: the square of twice the sine of the object angle.
float squared_turn(TrackedBall followed) {
  vec3 difference = followed.a.towards - followed.b.towards;
  return dot(difference, difference);
}

#endif
