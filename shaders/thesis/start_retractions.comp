#version 450
#extension GL_GOOGLE_include_directive : enable
// Algorithm 2, its loop over samples: the segment from a sample phi to its opposite, and whether B(opp(phi)) differs
// from B(phi), that is, whether the ball around opp(phi) through B(phi) holds boundary points. Segments that miss the
// voxel cannot end in it.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Voxels { ThesisCell voxels[]; };
layout(set = 0, binding = 2) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 3) readonly buffer Samples { vec4 samples[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { vec4 nearest[]; };
layout(set = 0, binding = 5) writeonly buffer Lines { Retraction lines[]; };
layout(set = 0, binding = 6) writeonly buffer Queries { vec4 queries[]; };
layout(set = 0, binding = 7) writeonly buffer Accepted { uint accepted[]; };

// False only if the segment ab misses the voxel: the part of the line between its three pairs of faces is empty.
bool meets_voxel(vec3 a, vec3 b, vec3 centre) {
  vec3 along = b - a;
  vec3 inverse = 1.0 / mix(along, vec3(1e-20), lessThan(abs(along), vec3(1e-20)));
  vec3 low = (centre - 0.5 * step.cell_size - step.slack - a) * inverse;
  vec3 high = (centre + 0.5 * step.cell_size + step.slack - a) * inverse;
  vec3 enter = min(low, high), leave = max(low, high);
  return max(max(enter.x, enter.y), max(enter.z, 0.0)) <= min(min(leave.x, leave.y), min(leave.z, 1.0));
}

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  uint slot = active_slots[item / kRetractionsPerRound];
  uint sample_index = step.first_sample + item % kRetractionsPerRound;
  accepted[item] = 0u;
  queries[item] = vec4(0.0, 0.0, 0.0, kPassOver);
  lines[item].p.w = 0.0;
  if (sample_index >= step.samples) return;
  ThesisCell voxel = voxels[slot];
  uint s = voxel.sphere * step.samples + sample_index;
  vec3 centre = cell_centre(voxel), phi = samples[s].xyz, contact = nearest[s].xyz;
  vec3 direction = unit_or_zero(contact - phi);
  vec3 opposite = phi - 2.0 * dot(phi - centre, direction) * direction;
  bool useful = nearest[s].w > 0.0 && distance(phi, opposite) > step.epsilon && meets_voxel(phi, opposite, centre);
  if (!useful) return;
  lines[item] = Retraction(vec4(phi, 1.0), vec4(opposite, 0.0), vec4(contact, 0.0), slot, item, 0u, 0u);
  queries[item] = ball_query(opposite, contact);
  atomicAdd(counters[kThesisQueries], 1u);
}
