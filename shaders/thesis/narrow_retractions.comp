#version 450
#extension GL_GOOGLE_include_directive : enable
// Algorithm 1, one step of every segment: B(m) = B(p) exactly if the ball around the middle m through B(p) is empty.
// Then queries the next middle, or, after the last step, the nearest point of q.
#include "thesis/thesis.glsl"
layout(constant_id = 1) const bool kLastStep = false;
layout(set = 0, binding = 1) readonly buffer Voxels { ThesisCell voxels[]; };
layout(set = 0, binding = 2) buffer Lines { Retraction lines[]; };
layout(set = 0, binding = 3) readonly buffer Empty { uint empty[]; };
layout(set = 0, binding = 4) buffer Queries { vec4 queries[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  if (lines[item].p.w == 0.0) return;
  atomicAdd(counters[kThesisQueries], 1u);
  vec3 p = lines[item].p.xyz, q = lines[item].q.xyz, m = queries[item].xyz;
  bool same = empty[item] == 1u;
  p = same ? m : p;
  q = same ? q : m;
  // The end is p, and it must lie in the voxel.
  vec3 centre = cell_centre(voxels[lines[item].voxel]);
  float half_side = 0.5 * step.cell_size;
  bool possible = all(lessThan(min(p, q) - centre, vec3(half_side))) && all(lessThan(centre - max(p, q), vec3(half_side)));
  if (kLastStep) possible = possible && all(lessThan(abs(p - centre), vec3(half_side - step.slack)));
  lines[item].p = vec4(p, possible ? 1.0 : 0.0);
  lines[item].q.xyz = q;
  vec4 query = kLastStep ? vec4(q, kAnyDistance) : ball_query(0.5 * (p + q), lines[item].contact.xyz);
  queries[item] = possible ? query : vec4(q, kPassOver);
}
