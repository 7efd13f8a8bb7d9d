#version 450
#extension GL_GOOGLE_include_directive : enable
// Marks the samples whose segments end at acceptable points.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Lines { Retraction lines[]; };
layout(set = 0, binding = 2) readonly buffer Empty { uint empty[]; };
layout(set = 0, binding = 3) readonly buffer Sides { vec4 sides[]; };
layout(set = 0, binding = 4) readonly buffer Numbers { vec2 numbers[]; };
layout(set = 0, binding = 5) writeonly buffer Accepted { uint accepted[]; };  // line + 1

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  if (lines[item].p.w == 0.0 || empty[item] == 1u) return;
  if (sides[item].w >= 0.0 && numbers[item].x < 0.5) return;
  accepted[lines[item].source] = item + 1u;
}
