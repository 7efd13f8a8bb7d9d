// Definitions that the kernels of the flux through spheres share: `samples` spiral points on each sphere (Section
// 2.3.2).
#ifndef MEDIAL_VK_SPHERE_SAMPLES_GLSL
#define MEDIAL_VK_SPHERE_SAMPLES_GLSL
#include "tree_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { SampleConstants push; };

layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Spheres { vec4 spheres[]; };  // centre, radius; negative: skipped

const float kAnyDistance = 3.4e38;  // squared
const float kPassOver = -1.0;

uint invocation_index() { return workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

uint sphere_count() { return push.items_counter == kNoCounter ? push.items : counters[push.items_counter]; }

vec3 unit_or_zero(vec3 v) {
  float squared = dot(v, v);
  return squared > 0.0 ? v * inversesqrt(squared) : vec3(0.0);
}

// The other end of the chord through a sphere's point p in direction d (Definition 2.3).
vec3 opposite(vec3 centre, vec3 p, vec3 d) { return p - 2.0 * dot(p - centre, d) * d; }

#endif
