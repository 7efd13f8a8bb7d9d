#version 450
#extension GL_GOOGLE_include_directive : enable
// Drops the cells that lie outside, and marks those that lie inside, whose descendants require no further test. The
// distance from the centre to the boundary is known for kept children; for top cells (step.second_task) a lower bound
// is known. Children whose side is unknown are packed (dismiss_cells.comp), so that neighbouring invocations have equal
// work.
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TREE_STORAGE_BINDING 1
#define TRIANGLE_TEXEL_BINDING 8
#define TREE_TEXEL_BINDING 9
#include "tree/triangles.glsl"
#include "tree/tree.glsl"
#include "tree/winding.glsl"
#include "tree/signed_crossings.glsl"

layout(set = 0, binding = 7) readonly buffer OpenEdges { OpenEdge open_edges[]; };
#include "certified/closure.glsl"
#include "certified/cell_side.glsl"

layout(set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) buffer States { uvec4 states[]; };
layout(set = 0, binding = 6) readonly buffer Requests { uint requests[]; };

void main() {
  uint index = invocation_index();
  bool is_top = step.second_task != 0u;
  if (index >= counters[is_top ? kParents : kRequests]) return;
  uint item = is_top ? index : requests[index];
  vec3 centre;
  float clearance;
  if (is_top) {
    centre = cell_centre(top_cell_coordinates(step.first_item + item));
    clearance = uintBitsToFloat(states[item].w);
    states[item].w = 0u;
  } else {
    centre = cell_centre(child_coordinates(parents[item / 8], item % 8));
    clearance = uintBitsToFloat(nearest[item].x);
  }
  uint side = side_of_cell(centre, clearance - step.slack);
  if (side == kSideInside) states[item].w |= kCellInside;
  if (side == kSideOutside) states[item] = uvec4(0);
  COUNT_LONG(kNodeTestCount, tested_nodes);
  COUNT_TESTS(tested_triangles);
}
