#version 450
#extension GL_GOOGLE_include_directive : enable
// Decides whether the accepted end of a line lies in the solid, if the side of its cell is unknown: next to the
// boundary, and around the open edges of a mesh. A point is inside if its winding number is at least 1/2. If the error
// bound leaves that open, the line is given up and the voxel stays undecided.
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TREE_STORAGE_BINDING 1
#define TRIANGLE_TEXEL_BINDING 7
#define TREE_TEXEL_BINDING 8
#include "tree/triangles.glsl"
#include "tree/tree.glsl"
#include "tree/winding.glsl"
#include "tree/signed_crossings.glsl"

layout(set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Lines { Line lines[]; };
layout(set = 0, binding = 4) readonly buffer Requests { uint requests[]; };
layout(set = 0, binding = 5) buffer Winners { uint winners[]; };
layout(set = 0, binding = 6) readonly buffer OpenEdges { OpenEdge open_edges[]; };
#include "certified/closure.glsl"
#include "lanes/elect.glsl"

bool is_inside_by_tree(vec3 point) {
  float tolerance = 0.3;  // decides most points at once
  Winding w;
  for (uint attempt = 0; attempt < 3u; ++attempt) {
    w = rough_winding_number(point, tolerance);
    if (attempt == 2u || abs(w.number - 0.5) > w.bound + kSumRounding) break;
    tolerance *= 0.1;
  }
  return w.complete && w.number - 0.5 >= w.bound + kSumRounding;
}

bool is_inside(vec3 point) {
  if (kIsOpen && step.open_edges > kMostOpenEdges) return is_inside_by_tree(point);
  vec3 direction = direction_out(point);
  Winding w = accurate_winding_number(point, direction, closure_at(point, 0.0, direction));
  return w.complete && w.number - 0.5 >= w.bound;
}

void main() {
  if (invocation_index() >= counters[kRequests]) return;
  uint index = requests[invocation_index()];
  vec3 point = lines[index].accepted == 1u ? lines[index].p.xyz : lines[index].q.xyz;
  float turn = dot(lines[index].toward_p.xyz, lines[index].toward_q.xyz);
  if (is_inside(point)) elect(index, lines[index].voxel, turn);
  COUNT_LONG(kNodeTestCount, tested_nodes);
  COUNT_TESTS(tested_triangles);
}
