#version 450
#extension GL_GOOGLE_include_directive : enable
// The first acceptable sample of every voxel gives its point; a voxel without one stays active.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Voxels { ThesisCell voxels[]; };
layout(set = 0, binding = 2) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 3) readonly buffer Lines { Retraction lines[]; };
layout(set = 0, binding = 4) readonly buffer Accepted { uint accepted[]; };
layout(set = 0, binding = 5) writeonly buffer Points { FoundPoint points[]; };
layout(set = 0, binding = 6) writeonly buffer States { uvec4 states[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  uint line = 0u;
  for (uint k = 0u; k < kRetractionsPerRound; ++k)
    line = line == 0u ? accepted[kRetractionsPerRound * item + k] : line;
  states[item] = uvec4(uint(line == 0u), 0u, 0u, 0u);
  if (line == 0u) return;
  uint slot = active_slots[item];
  ThesisCell voxel = voxels[slot];
  vec3 p = lines[line - 1u].p.xyz, to_contact = lines[line - 1u].contact.xyz - p;
  vec4 q = lines[line - 1u].q;
  points[slot] = FoundPoint(vec4(p, length(to_contact)), vec4(unit_or_zero(to_contact), q.w), vec4(q.xyz, voxel.flux),
                            voxel.x, voxel.y, voxel.z, 1u);
}
