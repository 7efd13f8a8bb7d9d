#version 450
#extension GL_GOOGLE_include_directive : enable
// One point per finest voxel: of the lines that found one at this level, the one with the largest turn, and of equal
// ones the first. The result does not depend on the order of the atomics.
#include "step.glsl"

layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Lines { Line lines[]; };
layout(set = 0, binding = 2) buffer Winners { uint winners[]; };

void main() {
  uint index = invocation_index();
  if (index >= counters[kLines] || lines[index].accepted == 0u) return;
  float turn = dot(lines[index].toward_p.xyz, lines[index].toward_q.xyz);
  uint rank = uint(clamp(0.5 + 0.5 * turn, 0.0, 1.0) * 1023.0);
  atomicMin(winners[lines[index].voxel], rank << 22 | index);
}
