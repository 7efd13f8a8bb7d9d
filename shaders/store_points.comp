#version 450
#extension GL_GOOGLE_include_directive : enable
// Writes the elected point of each finest voxel.
#include "step.glsl"

layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Lines { Line lines[]; };
layout(set = 0, binding = 2) readonly buffer Winners { uint winners[]; };
layout(set = 0, binding = 3) readonly buffer Voxels { Cell voxels[]; };
layout(set = 0, binding = 4) buffer Verdicts { uint verdicts[]; };
layout(set = 0, binding = 5) writeonly buffer Points { FoundPoint points[]; };

void main() {
  uint index = invocation_index();
  if (index >= counters[kLines]) return;
  Line line = lines[index];
  if (line.accepted == 0u || (winners[line.voxel] & 0x3fffffu) != index) return;
  bool by_p = line.accepted == 1u;
  vec4 centre = by_p ? line.p : line.q;
  vec3 a = by_p ? line.toward_p.xyz : line.toward_q.xyz;
  vec3 b = by_p ? line.toward_q.xyz : line.toward_p.xyz;
  float angle = 0.5 * acos(clamp(dot(a, b), -1.0, 1.0));
  Cell voxel = voxels[line.voxel];
  points[line.voxel] = FoundPoint(centre, vec4(a, angle), vec4(b, 0.0), voxel.x, voxel.y, voxel.z, line.voxel);
  verdicts[line.voxel] = kVerdictFound | verdicts[line.voxel];
  COUNT(kFoundCount, 1u);
}
