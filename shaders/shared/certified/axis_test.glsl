// Dismissal by an axis (docs/theory.md): a cell is empty if some axis satisfies, for every contact t, one of the
// conditions
//   the trusted outward normal of t is within theta of the axis, or
//   D_t > rho and angle(g_t, axis) + asin(rho / D_t) < theta,
// because then every spoke of every medial point in the cell lies within theta of the axis. Include after
// "triangles.glsl".
#ifndef MEDIAL_VK_AXIS_TEST_GLSL
#define MEDIAL_VK_AXIS_TEST_GLSL

#include "certified/dismissal.glsl"

// The two cones of axes that a contact obeys: by its normal and by its direction (half-angle below 0: no axis).
struct Obedience {
  vec3 normal, direction;
  float by_normal, by_direction;
};

Obedience obedience_of(uint t, vec3 centre, float theta) {
  TriangleTexels texels = load_triangle(t);
  vec3 v = vector_to_triangle(centre, texels);
  vec3 g = unit_or_zero(v);
  float d = length(v), rho = step.circumradius;
  return Obedience(texels.normal.xyz, g, texels.normal.w > 0.5 ? theta : -8.0,
                   d > rho ? theta - asin(min(1.0, rho / d)) : -8.0);
}

bool cones_meet(vec3 a, float half_a, vec3 b, float half_b) {
  float sum = half_a + half_b;
  return half_a > 0.0 && half_b > 0.0 && (sum >= 3.1 || dot(a, b) > cos(sum));
}

// True if no axis obeys both contacts, so that further sweeps are useless.
bool incompatible(Obedience a, Obedience b) {
  return !cones_meet(a.normal, a.by_normal, b.normal, b.by_normal) &&
         !cones_meet(a.normal, a.by_normal, b.direction, b.by_direction) &&
         !cones_meet(a.direction, a.by_direction, b.normal, b.by_normal) &&
         !cones_meet(a.direction, a.by_direction, b.direction, b.by_direction);
}

#endif
