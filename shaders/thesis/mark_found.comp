#version 450
#extension GL_GOOGLE_include_directive : enable
// Marks the finest voxels that have a point.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Points { FoundPoint points[]; };
layout(set = 0, binding = 2) writeonly buffer States { uvec4 states[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  states[item] = uvec4(points[item].cell, 0u, 0u, 0u);
}
