#version 450
#extension GL_GOOGLE_include_directive : enable
// Packs the remaining cells; their contact lists are not moved.
#include "certified/step.glsl"

layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 2) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 3) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 4) writeonly buffer Left { Cell left[]; };

void main() {
  uint index = invocation_index();
  if (index >= counters[kCells] || states[index].x == 0u) return;
  left[offsets[index].x] = cells[index];
}
