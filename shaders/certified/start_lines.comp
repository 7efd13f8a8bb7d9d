#version 450
#extension GL_GOOGLE_include_directive : enable
// Packs the lines worth narrowing. A point that needs no line becomes a line of length zero: narrowing finds its whole
// turn in the last part, between the point and the same point with the other direction.
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 9
#include "tree/triangles.glsl"

layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 4) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 5) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 6) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 7) writeonly buffer Lines { Line lines[]; };
layout(set = 0, binding = 8) writeonly buffer Work { uint work[]; };  // number of contacts that a line reads

void main() {
  uint index = invocation_index();
  if (index >= step.lines_per_cell * counters[kCells] || states[index].x == 0u) return;
  vec3 p = points[2 * index].xyz, q = points[2 * index + 1].xyz;
  vec3 a = vector_to_triangle(p, load_triangle(nearest[2 * index].y));
  vec3 b = vector_to_triangle(q, load_triangle(nearest[2 * index + 1].y));
  if (points[2 * index].w == float(kDirectSeed)) {
    b = length(a) * q;
    q = p;
  }
  uint cell = index / step.lines_per_cell;
  COUNT(kLineCount, 1u);
  work[offsets[index].x] = states[index].w;
  lines[offsets[index].x] = Line(vec4(p, length(a)), vec4(q, length(b)), vec4(unit_or_zero(a), 0.0),
                                 vec4(unit_or_zero(b), 0.0), cell, cells[cell].voxel, 0u, index % step.lines_per_cell);
}
