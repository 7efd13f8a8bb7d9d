#version 450
#extension GL_GOOGLE_include_directive : enable
// The spheres whose flux is measured, in the order of their cells.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) buffer Cells { ThesisCell cells[]; };
layout(set = 0, binding = 2) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Spheres { vec4 spheres[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count() || states[item].x == 0u) return;
  cells[item].sphere = offsets[item].x;
  spheres[offsets[item].x] = vec4(cell_centre(cells[item]), step.cell_size);
}
