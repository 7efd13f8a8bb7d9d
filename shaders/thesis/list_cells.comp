#version 450
#extension GL_GOOGLE_include_directive : enable
// The cells of a level: top cells of the chunk, or the children of the cells that were kept. Queries the boundary point
// nearest to each centre.
#include "thesis/thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Parents { ThesisCell parents[]; };
layout(set = 0, binding = 2) writeonly buffer Cells { ThesisCell cells[]; };
layout(set = 0, binding = 3) writeonly buffer Queries { vec4 queries[]; };

ThesisCell top_cell(uint index) {
  uint row = index / step.top_x;
  return ThesisCell(index % step.top_x, row % step.top_y, row / step.top_y, 0u, 0.0, 0.0, 0u, 0u);
}

ThesisCell child_cell(ThesisCell parent, uint child) {
  uvec3 c = 2u * uvec3(parent.x, parent.y, parent.z) + uvec3(child & 1u, (child >> 1) & 1u, child >> 2);
  // No closed boundary lies between the centres if the parent's is further from it than from the child's.
  float apart = 0.8660255 * step.cell_size;
  bool same_side = step.closed != 0u && parent.distance > apart + step.slack;
  uint flags = same_side ? parent.flags & (kThesisSideKnown | kThesisInside) : 0u;
  return ThesisCell(c.x, c.y, c.z, flags, 0.0, 0.0, 0u, 0u);
}

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  ThesisCell cell = step.level == 0u ? top_cell(step.first_cell + item) : child_cell(parents[item / 8u], item % 8u);
  uvec3 first_voxel = uvec3(cell.x, cell.y, cell.z) * step.voxels_per_cell;
  bool present = all(lessThan(first_voxel, uvec3(step.grid_x, step.grid_y, step.grid_z)));
  cell.flags |= present ? kThesisPresent : 0u;
  cells[item] = cell;
  queries[item] = vec4(cell_centre(cell), present ? kAnyDistance : kPassOver);
  if (present) atomicAdd(counters[kThesisQueries], 1u);
}
