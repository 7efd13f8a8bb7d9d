// Dismissal while a list is written (docs/theory.md, "Clusters"): tests whether one of two axes is obeyed by all
// triangles that touch the cube. The axes are the normal of the nearest triangle and the mean of the clusters' axes.
// Include lanes.glsl, step.glsl and triangles.glsl before.
#ifndef MEDIAL_VK_TWO_AXES_GLSL
#define MEDIAL_VK_TWO_AXES_GLSL
#include "certified/dismissal.glsl"

struct Axes {
  vec3 front, mean;
  vec2 least;  // for each axis, the cosine to the normal that is farthest from it
};

Axes axes_of(uint nearest, uint packed_mean) {
  return Axes(triangle_texel(4u * nearest + 3u).xyz, unit_or_zero(unpackSnorm4x8(packed_mean).xyz), vec2(2.0));
}

vec2 cosines(Axes axes, vec4 normal) {
  vec2 found = vec2(dot(normal.xyz, axes.front), dot(normal.xyz, axes.mean));
  return normal.w > 0.5 ? found : vec2(-2.0);  // not trusted
}

// For all eight lanes.
bool is_obeyed(Axes axes, float theta) {
  return max(least_of_lanes(axes.least.x), least_of_lanes(axes.least.y)) > cosine(theta) + kAxisSlack;
}

#endif
