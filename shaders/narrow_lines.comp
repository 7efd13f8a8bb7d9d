#version 450
#extension GL_GOOGLE_include_directive : enable
// One narrowing step: of the nine parts that the eight inner points make of a line, the one over which the direction
// to the boundary turns most. (Bisection towards the first change of the nearest point, Algorithm 1, would end at a
// crease between neighbouring facets.) Directions also flip where the line crosses the boundary itself, and there the
// distances at the ends of the part add up to no more than its length: such a part is taken only if no other turns
// enough.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 4
#include "triangles.glsl"

layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) buffer Lines { Line lines[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { uvec2 nearest[]; };

void main() {
  uint index = invocation_index();
  if (index >= counters[kLines]) return;
  vec3 p = lines[index].p.xyz, q = lines[index].q.xyz;
  vec4 last_point = lines[index].p, last_toward = lines[index].toward_p;
  vec4 best_p = last_point, best_q = last_point, best_toward_p = last_toward, best_toward_q = last_toward;
  float best_turn = 4.0;
  for (uint k = 1; k <= kSectionsPerLine + 1u; ++k) {
    vec4 point = lines[index].q, toward = lines[index].toward_q;
    if (k <= kSectionsPerLine) {
      point.xyz = mix(p, q, float(k) / float(kSectionsPerLine + 1u));
      vec3 v = vector_to_triangle(point.xyz, load_triangle(nearest[kSectionsPerLine * index + k - 1u].y));
      point.w = length(v);
      toward.xyz = unit_or_zero(v);
    }
    float turn = dot(last_toward.xyz, toward.xyz);
    bool may_cross = last_point.w + point.w <= 1.001 * distance(last_point.xyz, point.xyz) + step.slack;
    turn += may_cross ? 1.0 + step.cos_twice_angle : 0.0;
    if (turn < best_turn) {
      best_turn = turn;
      best_p = last_point;
      best_q = point;
      best_toward_p = last_toward;
      best_toward_q = toward;
    }
    last_point = point;
    last_toward = toward;
  }
  lines[index].p = best_p;
  lines[index].q = best_q;
  lines[index].toward_p = best_toward_p;
  lines[index].toward_q = best_toward_q;
}
