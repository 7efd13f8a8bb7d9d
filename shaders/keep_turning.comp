#version 450
#extension GL_GOOGLE_include_directive : enable
// A line is worth narrowing if the direction to the boundary turns by at least twice the object angle between its
// ends. Points that need no line have been asked for that already.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 5
#include "triangles.glsl"

layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 4) writeonly buffer States { uvec4 states[]; };

void main() {
  uint index = invocation_index();
  if (index >= step.lines_per_cell * counters[kCells]) return;
  states[index] = uvec4(0);
  if (points[2 * index].w < 0.0) return;
  if (points[2 * index].w == float(kDirectSeed)) {
    states[index] = uvec4(1u, 0u, 0u, 0u);
    return;
  }
  vec3 a = vector_to_triangle(points[2 * index].xyz, load_triangle(nearest[2 * index].y));
  vec3 b = vector_to_triangle(points[2 * index + 1].xyz, load_triangle(nearest[2 * index + 1].y));
  float turn = dot(unit_or_zero(a), unit_or_zero(b));
  bool deep = max(length(a), length(b)) + step.slack >= step.radius;
  float threshold = deep ? max(step.cos_twice_angle, step.cos_twice_deep_angle) : step.cos_twice_angle;
  states[index] = uvec4(turn <= threshold ? 1u : 0u, 0u, 0u, 0u);
}
