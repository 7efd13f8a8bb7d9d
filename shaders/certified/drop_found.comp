#version 450
#extension GL_GOOGLE_include_directive : enable
// Runs after the search of a level: voxels that have elected a line receive their point from the cell of that line, and
// all their cells are finished. The remaining cells are subdivided, or stay undecided: at the last level, or where
// subdivision is hopeless or settles nothing. If another search of the level follows (step.second_task), all remaining
// cells go there.
#include "certified/step.glsl"

layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Winners { uint winners[]; };
layout(set = 0, binding = 3) readonly buffer Lines { Line lines[]; };
layout(set = 0, binding = 4) readonly buffer Voxels { Cell voxels[]; };
layout(set = 0, binding = 5) buffer GivenUp { uint given_up[]; };
layout(set = 0, binding = 6) writeonly buffer Points { FoundPoint points[]; };
layout(set = 0, binding = 7) writeonly buffer States { uvec4 states[]; };

void store_point(Line line) {
  bool by_p = line.accepted == 1u;
  vec4 centre = by_p ? line.p : line.q;
  vec3 a = by_p ? line.toward_p.xyz : line.toward_q.xyz;
  vec3 b = by_p ? line.toward_q.xyz : line.toward_p.xyz;
  float angle = 0.5 * acos(clamp(dot(a, b), -1.0, 1.0));
  Cell voxel = voxels[line.voxel];
  points[line.voxel] = FoundPoint(centre, vec4(a, angle), vec4(b, 0.0), voxel.x, voxel.y, voxel.z, line.voxel);
  COUNT(kFoundCount, 1u);
}

void main() {
  uint index = invocation_index();
  if (index >= counters[kCells]) return;
  uint voxel = cells[index].voxel, flags = cells[index].flags, winner = winners[voxel];
  bool found = winner != kNoWinner;
  if (found) {
    Line line = lines[winner & ((1u << kRankShift) - 1u)];
    if (line.cell == index) store_point(line);
  }
  bool done = found || (flags & kCellEmpty) != 0u;
  bool last = step.second_task == 0u && ((step.ends & kEndsAll) != 0u || is_hopeless(flags) || (flags & kCellSettled) != 0u);
  if (!done && last) atomicOr(given_up[voxel], kGivenUpBit);
  if (!done && !last && step.depth > 0u) atomicAdd(given_up[voxel], 1u);
  states[index] = uvec4(done || last ? 0u : 1u, 0u, 0u, 0u);
}
