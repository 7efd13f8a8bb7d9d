// Contacts that move with their triangles. Include frame.glsl before.
#ifndef MEDIAL_VK_FOLLOWING_CONTACTS_GLSL
#define MEDIAL_VK_FOLLOWING_CONTACTS_GLSL

vec3 point_of(FollowContact contact) {
  Corners t = corners_of(contact.triangle);
  return t.a + (contact.v * (t.b - t.a) + contact.w * (t.c - t.a));
}

bool is_within_face(FollowContact contact) {
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
FollowContact carry(FollowContact contact) {
  vec3 inward = inward_normal(contact.triangle);
  DualEdges dual = dual_edges(corners_of(contact.triangle), inward);
  vec3 image = unit_or_zero(contact.carried.x * dual.ab + contact.carried.y * dual.ac + contact.carried.z * inward);
  bool is_carried = contact.carried.w == 1.0 && dot(inward, inward) > 0.5 && dot(image, image) > 0.5;
  contact.towards.xyz = is_carried ? image : contact.towards.xyz;
  return contact;
}

// With what the next frame needs of this one.
FollowContact keep(FollowContact contact) {
  vec3 inward = inward_normal(contact.triangle);
  Corners t = corners_of(contact.triangle);
  vec3 d = contact.towards.xyz;
  contact.carried = vec4(dot(d, t.b - t.a), dot(d, t.c - t.a), dot(d, inward), dot(inward, inward) > 0.5 ? 1.0 : 0.0);
  return contact;
}

// The share of the way along `side` at which `offset` from its start lies.
float share_along(vec3 offset, vec3 side) {
  float square = dot(side, side);
  return square > 1e-30 ? clamp(dot(offset, side) / square, 0.0, 1.0) : 0.0;
}

// A point of a triangle, up to rounding. Without an area the triangle does not leave its longest side.
FollowContact contact_at(vec3 point, uint triangle, vec3 towards) {
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
  return FollowContact(vec4(towards, 0.0), vec4(0.0), triangle, shares.x, shares.y, 0u);
}

// The radius of the ball that touches `at` with its centre along `towards`, and passes through `other`; a large number,
// if that lies on the other side.
float radius_through(vec3 at, vec3 towards, vec3 other) {
  vec3 w = other - at;
  float along = dot(towards, w), square = dot(w, w);
  return along > 1e-30 && square < 1e8 * along ? square / (2.0 * along) : 1e8;
}

// By both directions: the square of twice the sine of the object angle.
float squared_turn(FollowedBall followed) {
  vec3 difference = followed.a.towards.xyz - followed.b.towards.xyz;
  return dot(difference, difference);
}

#endif
