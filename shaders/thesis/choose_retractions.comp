#version 450
#extension GL_GOOGLE_include_directive : enable
// The segments whose ends have different nearest points: a medial point lies on them (Lemma 2.3).
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Lines { Retraction lines[]; };
layout(set = 0, binding = 2) readonly buffer Empty { uint empty[]; };
layout(set = 0, binding = 3) writeonly buffer States { uvec4 states[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  states[item] = uvec4(uint(lines[item].p.w > 0.0 && empty[item] == 0u), 0u, 0u, 0u);
}
