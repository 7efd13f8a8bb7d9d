#version 450
#extension GL_GOOGLE_include_directive : enable
// Closest-point queries at the spiral points of every sphere.
#include "tree/sphere_samples.glsl"
layout(set = 0, binding = 2) readonly buffer Directions { vec4 directions[]; };
layout(set = 0, binding = 3) writeonly buffer Queries { vec4 queries[]; };

void main() {
  uint index = invocation_index();
  uint sphere = index / push.samples;
  if (sphere >= sphere_count()) return;
  vec4 s = spheres[sphere];
  vec3 point = s.xyz + s.w * directions[index % push.samples].xyz;
  queries[index] = vec4(point, s.w < 0.0 ? kPassOver : kAnyDistance);
}
