#version 450
#extension GL_GOOGLE_include_directive : enable
// The cells that are kept, in order. At the finest level each becomes a slot without a point.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Cells { ThesisCell cells[]; };
layout(set = 0, binding = 2) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Kept { ThesisCell kept[]; };
layout(set = 0, binding = 5) writeonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 6) writeonly buffer Points { FoundPoint points[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count() || states[item].x == 0u) return;
  uint slot = offsets[item].x;
  kept[slot] = cells[item];
  if (step.finest == 0u) return;
  active_slots[slot] = slot;
  points[slot].cell = 0u;
}
