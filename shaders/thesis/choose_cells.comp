#version 450
#extension GL_GOOGLE_include_directive : enable
// Determines the cells that are kept: above the finest level those with positive flux; at the finest level those with
// more than (3/8) sin(theta), or far enough from the boundary to hold a point of the radius threshold (2.4.2).
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) buffer Cells { ThesisCell cells[]; };
layout(set = 0, binding = 2) buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Fluxes { vec4 fluxes[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  uvec4 state = states[item];
  bool keep = state.y != 0u;
  if (state.x != 0u) {
    vec4 flux = fluxes[cells[item].sphere];
    cells[item].flux = flux.x;
    bool deep = step.finest != 0u && flux.y > step.radius - 2.0 * step.cell_size;
    keep = keep || flux.x > step.least_flux || deep;
  }
  states[item] = uvec4(uint(keep), 0u, 0u, 0u);
}
