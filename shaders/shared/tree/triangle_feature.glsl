// The feature of a triangle that is nearest to a point: 0 the face, 1 an edge, 2 a vertex. The arithmetic is that of
// vector_to_triangle() in closest_point.glsl.
#ifndef MEDIAL_VK_TRIANGLE_FEATURE_GLSL
#define MEDIAL_VK_TRIANGLE_FEATURE_GLSL
#include "tree/closest_point.glsl"

bool foot_is_inside(vec3 p, TriangleTexels t) {
  vec3 e = p - t.a.xyz;
  vec3 f = e - t.ab.xyz;
  return dot(cross(t.ab.xyz, e), t.normal.xyz) > 0.0 && dot(cross(e, t.ac.xyz), t.normal.xyz) > 0.0 &&
         dot(cross(t.ac.xyz - t.ab.xyz, f), t.normal.xyz) > 0.0;
}

uint feature_of_triangle(vec3 p, TriangleTexels t) {
  vec3 e = p - t.a.xyz;
  vec3 f = e - t.ab.xyz;
  vec3 bc = t.ac.xyz - t.ab.xyz;
  float s_ab = clamp(dot(e, t.ab.xyz) * t.a.w, 0.0, 1.0);
  float s_ac = clamp(dot(e, t.ac.xyz) * t.ab.w, 0.0, 1.0);
  float s_bc = clamp(dot(f, bc) * t.ac.w, 0.0, 1.0);
  vec3 to_ab = s_ab * t.ab.xyz - e;
  vec3 to_ac = s_ac * t.ac.xyz - e;
  vec3 to_bc = s_bc * bc - f;
  float d_ab = dot(to_ab, to_ab);
  float d_ac = dot(to_ac, to_ac);
  float s = d_ac < d_ab ? s_ac : s_ab;
  s = dot(to_bc, to_bc) < min(d_ab, d_ac) ? s_bc : s;
  return foot_is_inside(p, t) ? 0u : (s > 0.0 && s < 1.0 ? 1u : 2u);
}

#endif
