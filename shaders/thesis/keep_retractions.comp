#version 450
#extension GL_GOOGLE_include_directive : enable
// The segments that are narrowed, in order, and the first query of each: its middle.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Lines { Retraction lines[]; };
layout(set = 0, binding = 2) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Kept { Retraction kept[]; };
layout(set = 0, binding = 5) writeonly buffer Queries { vec4 queries[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count() || states[item].x == 0u) return;
  Retraction line = lines[item];
  kept[offsets[item].x] = line;
  queries[offsets[item].x] = ball_query(0.5 * (line.p.xyz + line.q.xyz), line.contact.xyz);
}
