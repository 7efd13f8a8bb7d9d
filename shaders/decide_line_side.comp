#version 450
#extension GL_GOOGLE_include_directive : enable
// Does the accepted end of a line lie in the solid? Asked where its cell does not know: next to the boundary, and
// everywhere if the mesh is open. Inside is where the winding number is at least 1/2; where the error bound leaves that
// open, the line is given up and the voxel stays undecided.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TREE_STORAGE_BINDING 1
#define TRIANGLE_TEXEL_BINDING 5
#define TREE_TEXEL_BINDING 6
#include "triangles.glsl"
#include "tree.glsl"
#include "winding.glsl"

layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) buffer Lines { Line lines[]; };
layout(set = 0, binding = 4) readonly buffer Asked { uint asked[]; };

const float kRounding = 1e-4;  // of the sum of solid angles in float

void main() {
  if (invocation_index() >= counters[kAsked]) return;
  uint index = asked[invocation_index()];
  vec3 point = lines[index].accepted == 1u ? lines[index].p.xyz : lines[index].q.xyz;
  float tolerance = 0.3;  // most points are clear at once; on a closed mesh all are
  Winding w;
  for (uint attempt = 0;; ++attempt) {
    w = winding_number(point, tolerance);
    if (attempt == 2u || abs(w.number - 0.5) > w.bound + kRounding) break;
    tolerance *= 0.1;
  }
  if (!w.complete || w.number - 0.5 < w.bound + kRounding) lines[index].accepted = 0u;
}
