// Definitions that the kernels of the published method share. Binding 0 is always the counters.
#ifndef MEDIAL_VK_THESIS_GLSL
#define MEDIAL_VK_THESIS_GLSL
#include "thesis_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { ThesisConstants step; };
layout(set = 0, binding = 0) buffer Counters { uint counters[]; };

const float kAnyDistance = 3.4e38;  // squared
const float kPassOver = -1.0;

uint invocation_index() { return workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
uint item_count() { return counters[step.items_counter] * step.items_multiplier; }

vec3 unit_or_zero(vec3 v) {
  float squared = dot(v, v);
  return squared > 0.0 ? v * inversesqrt(squared) : vec3(0.0);
}

vec3 cell_centre(ThesisCell cell) { return (vec3(cell.x, cell.y, cell.z) + 0.5) * step.cell_size; }

// The ball around m through a boundary point, to test whether another one is nearer to m; reduced by a bound of the
// rounding.
vec4 ball_query(vec3 m, vec3 contact) {
  float r = max(distance(m, contact) - step.ball_margin, 0.0);
  return vec4(m, r * r);
}

#endif
