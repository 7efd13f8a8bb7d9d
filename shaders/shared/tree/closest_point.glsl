// Nearest point of a triangle, in float, safe for needles.
//
// The distance to a triangle is the distance to its plane if the foot of the perpendicular lies inside, and otherwise
// the smallest distance to its three edges. Both are computed without the differences of products of edge lengths
// (Ericson 2005, 5.1.5) that cancel on needles. With coordinates in the unit box and u = 2^-24, the error of an edge
// distance is at most about 8 u (|p - a| + |edge|), that of the plane distance 6 u |p - a|, and where rounding puts the
// foot on the wrong side of an edge the two differ by no more than that: below 2e-6 for any query in the box.
//
// A triangle is four texels: (a, 1/|ab|^2) (b - a, 1/|ac|^2) (c - a, 1/|bc|^2) (unit normal, 0 if it is not trusted and
// otherwise 1 + the sine of the greatest turn of spokes to the triangle from it: Lemma L). Inverse lengths of
// zero-length edges are 0.
#ifndef MEDIAL_VK_CLOSEST_POINT_GLSL
#define MEDIAL_VK_CLOSEST_POINT_GLSL

struct TriangleTexels {
  vec4 a;
  vec4 ab;
  vec4 ac;
  vec4 normal;
};

// True if the foot of the perpendicular is on the inner side of all edges. e and f: the point from a and from b.
// Factors of the triangle alone come first, for callers that evaluate several points.
bool projects_inside(vec3 e, vec3 f, vec3 bc, TriangleTexels t) {
  vec3 within_ab = cross(t.normal.xyz, t.ab.xyz), within_ac = cross(t.ac.xyz, t.normal.xyz);
  vec3 within_bc = cross(t.normal.xyz, bc);
  bool in_ab = dot(e, within_ab) > 0.0, in_ac = dot(e, within_ac) > 0.0, in_bc = dot(f, within_bc) > 0.0;
  return in_ab && in_ac && in_bc;
}

// The vector from p to the nearest point of the triangle.
vec3 vector_to_triangle(vec3 p, TriangleTexels t) {
  vec3 e = p - t.a.xyz;
  vec3 f = e - t.ab.xyz;
  vec3 bc = t.ac.xyz - t.ab.xyz;
  vec3 to_ab = clamp(dot(e, t.ab.xyz) * t.a.w, 0.0, 1.0) * t.ab.xyz - e;
  vec3 to_ac = clamp(dot(e, t.ac.xyz) * t.ab.w, 0.0, 1.0) * t.ac.xyz - e;
  vec3 to_bc = clamp(dot(f, bc) * t.ac.w, 0.0, 1.0) * bc - f;
  float d_ab = dot(to_ab, to_ab);
  float d_ac = dot(to_ac, to_ac);
  float d_bc = dot(to_bc, to_bc);
  vec3 best = d_ac < d_ab ? to_ac : to_ab;
  best = d_bc < min(d_ab, d_ac) ? to_bc : best;
  vec3 to_plane = -dot(e, t.normal.xyz) * t.normal.xyz;
  return projects_inside(e, f, bc, t) ? to_plane : best;
}

float squared_distance_to_triangle(vec3 p, TriangleTexels t) {
  vec3 e = p - t.a.xyz;
  vec3 f = e - t.ab.xyz;
  vec3 bc = t.ac.xyz - t.ab.xyz;
  vec3 to_ab = clamp(dot(e, t.ab.xyz) * t.a.w, 0.0, 1.0) * t.ab.xyz - e;
  vec3 to_ac = clamp(dot(e, t.ac.xyz) * t.ab.w, 0.0, 1.0) * t.ac.xyz - e;
  vec3 to_bc = clamp(dot(f, bc) * t.ac.w, 0.0, 1.0) * bc - f;
  float edges = min(min(dot(to_ab, to_ab), dot(to_ac, to_ac)), dot(to_bc, to_bc));
  float height = dot(e, t.normal.xyz), plane = height * height;
  return projects_inside(e, f, bc, t) ? plane : edges;
}

#endif
