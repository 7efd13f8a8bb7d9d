#version 450
#extension GL_GOOGLE_include_directive : enable
// Queries the winding number of those centres whose side of the boundary is not known from the level above.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) buffer Cells { ThesisCell cells[]; };
layout(set = 0, binding = 2) readonly buffer Nearest { vec4 nearest[]; };
layout(set = 0, binding = 3) buffer Queries { vec4 queries[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  uint flags = cells[item].flags;
  bool present = (flags & kThesisPresent) != 0u;
  if (present) cells[item].distance = sqrt(nearest[item].w);
  queries[item].w = present && (flags & kThesisSideKnown) == 0u ? kAnyDistance : kPassOver;
}
