#version 450
#extension GL_GOOGLE_include_directive : enable
// On which side of a closed boundary a kept child lies, if its ball does not meet the boundary: the winding number of
// the centre holds for all of it. Outside, it is dropped; inside, its descendants need not ask again.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TREE_STORAGE_BINDING 1
#define TRIANGLE_TEXEL_BINDING 6
#define TREE_TEXEL_BINDING 7
#include "triangles.glsl"
#include "tree.glsl"
#include "winding.glsl"

layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) buffer States { uvec4 states[]; };

// The winding number is whole here: an error below 1/4 decides between 0 and 1.
const float kTolerance = 0.2;

void main() {
  uint item = invocation_index();
  if (item >= 8u * counters[kParents] || step.closed == 0u) return;
  if (states[item].x == 0u || (states[item].w & kCellInside) != 0u) return;
  if (sqrt(uintBitsToFloat(nearest[item].x)) <= step.circumradius + step.slack) return;
  Winding w = winding_number(cell_centre(child_coordinates(parents[item / 8], item % 8)), kTolerance);
  if (!w.complete) return;  // not known: the cell is kept, and its points will be asked one by one
  if (w.number >= 0.5)
    states[item].w |= kCellInside;
  else
    states[item] = uvec4(0);
}
