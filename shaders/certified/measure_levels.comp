#version 450
#extension GL_GOOGLE_include_directive : enable
// Measures, for cells through which the boundary passes with untrusted triangles, the winding number at the centre and
// the rate of its change around it, from which foot_sides.glsl derives the winding numbers on both sides of a triangle
// (docs/theory.md, Lemma K). Nothing is stored where open edges are too near.
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TREE_STORAGE_BINDING 1
#define TRIANGLE_TEXEL_BINDING 5
#define TREE_TEXEL_BINDING 6
#include "tree/triangles.glsl"
#include "tree/tree.glsl"
#include "tree/winding.glsl"
#include "tree/signed_crossings.glsl"

layout(set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) buffer Cells { Cell cells[]; };
layout(set = 0, binding = 4) readonly buffer OpenEdges { OpenEdge open_edges[]; };
#include "certified/closure.glsl"

const float kMostChange = 0.2;  // over the circumradius

void main() {
  uint index = invocation_index();
  if (index >= counters[kCells]) return;
  Cell cell = cells[index];
  if ((cell.flags & kCellUntrusted) == 0u) return;
  vec3 centre = cell_centre(uvec3(cell.x, cell.y, cell.z));
  if (length(vector_to_triangle(centre, load_triangle(cell.nearest))) <= 4.0 * step.slack) return;
  float radius = 3.0 * step.circumradius + step.slack;
  vec3 direction = direction_out(centre);
  Closure closure = closure_at(centre, radius, direction);
  float bent = length(closure.gradient) + 2e-3 * closure.slope + 2.0 * (radius + step.slack) * closure.bend;
  float change = step.circumradius * min(closure.slope, bent);
  if (!(change < kMostChange)) return;
  Winding w = accurate_winding_number(centre, direction, closure);
  COUNT_LONG(kNodeTestCount, tested_nodes);
  COUNT_TESTS(tested_triangles);
  if (!w.complete || w.bound > 0.1) return;
  // Rounded up: the relative error of halves is 2^-11.
  float most = w.number + w.bound;
  cells[index].winding = packHalf2x16(vec2(most + 1e-3 * (1.0 + abs(most)), 1.001 * change + 1e-6));
  cells[index].flags = cell.flags | kCellMeasured;
}
