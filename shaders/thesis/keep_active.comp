#version 450
#extension GL_GOOGLE_include_directive : enable
// The voxels that are still without a point, in order.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 2) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Kept { uint kept[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count() || states[item].x == 0u) return;
  kept[offsets[item].x] = active_slots[item];
}
