#version 450
#extension GL_GOOGLE_include_directive : enable
// After the search of a level: cells of voxels that have their point are done. What is left is subdivided, or stays
// undecided: at the last level, or where subdividing is hopeless or settles nothing. Where another search of the
// level follows (step.second_task), all that is left goes there.
#include "step.glsl"

layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) buffer Verdicts { uint verdicts[]; };
layout(set = 0, binding = 3) writeonly buffer States { uvec4 states[]; };

void main() {
  uint index = invocation_index();
  if (index >= counters[kCells]) return;
  uint voxel = cells[index].voxel;
  bool found = (verdicts[voxel] & kVerdictFound) != 0u;
  bool done = found || (cells[index].flags & kCellEmpty) != 0u;
  uint flags = cells[index].flags;
  bool last = step.second_task == 0u && (step.last_level != 0u || is_hopeless(flags) || (flags & kCellSettled) != 0u);
  if (!done && last) atomicOr(verdicts[voxel], kVerdictUndecided);
  states[index] = uvec4(done || last ? 0u : 1u, 0u, 0u, 0u);
}
