#version 450
#extension GL_GOOGLE_include_directive : enable
// Section 2.3.2, step 1: a cell whose sphere (its side as radius) lies inside the solid is judged by its flux. A cell
// whose sphere meets the boundary is subdivided without a test; at the finest level it is searched if narrow features
// are requested (2.4.3), and its flux is measured to be stored. Cells wholly outside are dropped.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) buffer Cells { ThesisCell cells[]; };
layout(set = 0, binding = 2) readonly buffer Numbers { vec2 numbers[]; };
layout(set = 0, binding = 3) writeonly buffer States { uvec4 states[]; };  // measure flux; keep in any case

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  states[item] = uvec4(0u);
  ThesisCell cell = cells[item];
  if ((cell.flags & kThesisPresent) == 0u) return;
  if ((cell.flags & kThesisSideKnown) == 0u) {
    cell.flags |= kThesisSideKnown | (numbers[item].x >= 0.5 ? kThesisInside : 0u);
    cells[item].flags = cell.flags;
  }
  bool inside = (cell.flags & kThesisInside) != 0u;
  float circumradius = 0.8660255 * step.cell_size;
  // An open boundary has no outside that a whole cell could be proved to lie in.
  if (step.closed != 0u && !inside && cell.distance > circumradius + step.slack) return;
  atomicAdd(counters[kThesisLevels + kThesisCountsPerLevel * step.level], 1u);
  bool sphere_inside = inside && cell.distance >= step.cell_size;
  bool finest = step.finest != 0u;
  bool keep = !sphere_inside && (!finest || step.narrow != 0u);
  states[item] = uvec4(uint(sphere_inside || (finest && keep)), uint(keep), 0u, 0u);
}
