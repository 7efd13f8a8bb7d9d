#version 450
#extension GL_GOOGLE_include_directive : enable
// The points that were found, in order, without gaps.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Points { FoundPoint points[]; };
layout(set = 0, binding = 2) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Found { FoundPoint found[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count() || states[item].x == 0u) return;
  found[offsets[item].x] = points[item];
}
