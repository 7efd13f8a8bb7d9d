// A cluster as the contact lists of large cells see it: a cylinder that holds its triangles, and a cone that holds
// their normals (docs/theory.md, "Clusters"). Both are convex, so Lemma A holds for the cylinder as for a triangle.
#ifndef MEDIAL_VK_CLUSTER_GLSL
#define MEDIAL_VK_CLUSTER_GLSL

// What of a Cluster is asked again and again.
struct ClusterBounds {
  vec4 centre;  // w: radius
  vec4 axis;    // w: cosine of the tilt, or kNoCone
  vec3 rest;    // half height, sine of the tilt, number of triangles
};

// The vector from p to the nearest point of the cylinder.
vec3 vector_to_cluster(vec3 p, ClusterBounds c) {
  vec3 to_centre = c.centre.xyz - p;
  float along = dot(to_centre, c.axis.xyz);
  vec3 across = to_centre - along * c.axis.xyz;
  float r = length(across);
  return across * max(0.0, 1.0 - c.centre.w / max(r, 1e-30)) +
         c.axis.xyz * (sign(along) * max(abs(along) - c.rest.x, 0.0));
}

// Cosine of the angle between two unit vectors and another one, together; where they make more than two right angles it
// is no more than 0. The sine of the first comes from the cross product: sqrt(1 - cosine^2) would lose half the digits.
float cosine_of_sum(vec3 a, vec3 b, float other_cosine, float other_sine) {
  return dot(a, b) * other_cosine - length(cross(a, b)) * other_sine;
}

// Cosine of the largest angle that a normal of the cluster may have with a unit vector; below -1 if nothing is known.
float least_cosine_of_normals(vec3 direction, ClusterBounds c) {
  return c.axis.w == kNoCone ? -2.0 : cosine_of_sum(direction, c.axis.xyz, c.axis.w, c.rest.y);
}

// The same for a spoke that goes from a point of the cell around p to the cluster. `g`: the direction to its middle.
float least_cosine_of_directions(vec3 p, vec3 direction, ClusterBounds c, out vec3 g) {
  vec3 v = c.centre.xyz - p;
  float far = length(v);
  float sine = (length(vec2(c.centre.w, c.rest.x)) + step.circumradius + 2.0 * step.slack) / max(far, 1e-30);
  g = v / max(far, 1e-30);
  return sine >= 1.0 ? -2.0 : cosine_of_sum(direction, g, sqrt(1.0 - sine * sine), sine);
}

// +1 if p lies behind the planes of all triangles of the cluster, -1 if in front of all, else 0. With v from p to the
// centre and s the radius of a ball around the cluster, a direction from p to one of its points is within
// asin(s / |v|) of v, and a normal within the tilt of the axis: all products are positive if the angle between v and
// the axis, and these two, add up to less than a right angle.
float side_of_cluster(vec3 p, ClusterBounds c) {
  vec3 v = c.centre.xyz - p;
  float s = length(vec2(c.centre.w, c.rest.x));
  float squared = dot(v, v) - s * s;
  if (c.axis.w == kNoCone || squared <= 0.0) return 0.0;
  float free = sqrt(squared);
  bool fits = c.axis.w * free > c.rest.y * s;  // the two alone are less
  float depth = dot(v, c.axis.xyz), least = c.rest.y * free + c.axis.w * s + 4.0 * step.slack;
  return fits && depth > least ? 1.0 : fits && depth < -least ? -1.0 : 0.0;
}

#endif
