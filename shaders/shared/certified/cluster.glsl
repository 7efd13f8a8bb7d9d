// A cluster as contact lists of large cells represent it: a cylinder that holds its triangles, and a cone that holds
// their normals (docs/theory.md, "Clusters"). Both are convex, so Lemma A holds for the cylinder as for a triangle.
#ifndef MEDIAL_VK_CLUSTER_GLSL
#define MEDIAL_VK_CLUSTER_GLSL
#include "certified/cluster_texels.glsl"

// The parts of a Cluster that are read repeatedly.
struct ClusterBounds {
  vec4 centre;  // w: radius
  vec4 axis;    // w: cosine of the tilt, or kNoCone
  vec3 rest;    // half height, sine of the tilt, number of triangles
};

ClusterBounds load_bounds(uint cluster) {
  float count = cluster_texel(cluster, kClusterPoint).w;
  return ClusterBounds(cluster_texel(cluster, kClusterCentre), cluster_texel(cluster, kClusterAxis),
                       vec3(cluster_texel(cluster, kClusterRest).xy, count));
}

// The vector from p to the nearest point of the cylinder.
vec3 vector_to_cluster(vec3 p, ClusterBounds c) {
  vec3 to_centre = c.centre.xyz - p;
  float along = dot(to_centre, c.axis.xyz);
  vec3 across = to_centre - along * c.axis.xyz;
  float r = length(across);
  return across * max(0.0, 1.0 - c.centre.w / max(r, 1e-30)) +
         c.axis.xyz * (sign(along) * max(abs(along) - c.rest.x, 0.0));
}

// Cosine of the sum of two angles: of that between two unit vectors, and of another one; if the sum exceeds two right
// angles, the value is no more than 0. The sine of the first angle comes from the cross product: sqrt(1 - cosine^2)
// would lose half the digits.
float cosine_of_sum(vec3 a, vec3 b, float other_cosine, float other_sine) {
  return dot(a, b) * other_cosine - length(cross(a, b)) * other_sine;
}

// Cosine of the largest angle between a normal of the cluster and a unit vector; below -1 if nothing is known.
float least_cosine_of_normals(vec3 direction, ClusterBounds c) {
  return c.axis.w == kNoCone ? -2.0 : cosine_of_sum(direction, c.axis.xyz, c.axis.w, c.rest.y);
}

// The same for a spoke from a point of the cell around p to the cluster. `g`: the direction to its middle.
float least_cosine_of_directions(vec3 p, vec3 direction, ClusterBounds c, out vec3 g) {
  vec3 v = c.centre.xyz - p;
  float far = length(v);
  float sine = (length(vec2(c.centre.w, c.rest.x)) + step.circumradius + 2.0 * step.slack) / max(far, 1e-30);
  g = v / max(far, 1e-30);
  return sine >= 1.0 ? -2.0 : cosine_of_sum(direction, g, sqrt(1.0 - sine * sine), sine);
}

// +1 if p lies behind the planes of all triangles of the cluster, -1 if it lies in front of all, else 0. From p, a
// point x of the cylinder is at least H along the axis n and at most L across it, and a normal is turned by at most the
// tilt from n: its product with x - p is least if the normal is turned by the full tilt against the part across:
// cos(tilt) H - sin(tilt) L.
float side_of_cluster(vec3 p, ClusterBounds c) {
  vec3 v = c.centre.xyz - p;
  float along = dot(v, c.axis.xyz);
  float least_along = abs(along) - c.rest.x, most_across = length(v - along * c.axis.xyz) + c.centre.w;
  bool is_clear = c.axis.w * least_along > c.rest.y * most_across + 4.0 * step.slack;
  return c.axis.w != kNoCone && is_clear ? sign(along) : 0.0;
}

#endif
