#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Which of a parent's contacts are contacts of each child: Lemma A (docs/theory.md), for the ball that the child's list
// must serve, and, sharper, for the cube itself: dismissal asks only what touches that. One invocation per parent and
// child; one bit per list entry.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 9
#include "triangles.glsl"

layout(set = 0, binding = 1) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 6) writeonly buffer TouchMasks { uint touch_masks[]; };
layout(set = 0, binding = 7) buffer Counts { uint counts[]; };
layout(set = 0, binding = 8) buffer Axes { vec4 axes[]; };  // sum of the contacts' normals: a first axis to try

float corner_distance[8];  // from the corners of the cube to the triangle nearest to its centre

// Lemma A for the cube: at some corner x_k, D_t - g_t.x_k <= dist(x_k, nearest).
bool touches_cube(vec3 v, float d) {
  vec3 h = step.half_side * (v / max(d, 1e-30));
  float most = -1.0;
  [[unroll]] for (uint k = 0; k < 8u; ++k)
    most = max(most, corner_distance[k] + dot(h, corner_sign(k)));
  return d - most <= distance_slack(d, step.circumradius);
}

void main() {
  uint item = invocation_index();
  if (item >= 8u * counters[kParents]) return;
  Cell parent = parents[item / 8];
  uint child = item % 8;
  uint entry = step.first_entry;
  if (entry >= parent.list_count) return;
  vec3 centre = cell_centre(child_coordinates(parent, child));
  TriangleTexels nearest_texels = load_triangle(nearest[item].y);
  vec3 to_nearest = vector_to_triangle(centre, nearest_texels);
  float nearest_distance = length(to_nearest);
  vec3 nearest_direction = unit_or_zero(to_nearest);
  float radius = step.list_radius;
  bool far = nearest_distance > radius;
  [[unroll]] for (uint k = 0; k < 8u; ++k)
    corner_distance[k] = sqrt(squared_distance_to_triangle(centre + step.half_side * corner_sign(k), nearest_texels));
  // dist(m, nearest) <= D0 - g0.x + |x|^2 / (2 D0): what curvature of the distance to a point adds.
  float bend = far ? radius * radius / (2.0 * nearest_distance) : 0.0;
  uint end = min(parent.list_count, entry + kEntriesPerRound);
  uint word_count = (parent.list_count + 31u) / 32u;
  uint base = 8u * parent.word_begin + child * word_count;
  uint count = entry == 0 ? 0u : counts[item];
  vec3 axis = entry == 0 ? vec3(0.0) : axes[item].xyz;
  uint word = 0, touch_word = 0;
  for (;;) {
    TriangleTexels texels = load_triangle(lists[parent.list_begin + entry]);
    vec3 v = vector_to_triangle(centre, texels);
    float d = length(v);
    float excess = d - nearest_distance - 6.0 * step.slack;  // docs/theory.md, "Rounding"
    float reach = far ? radius * length(v / max(d, 1e-30) - nearest_direction) + bend : 2.0 * radius;
    bool contact = excess <= reach;
    word |= contact ? 1u << (entry & 31u) : 0u;
    bool touches = contact && touches_cube(v, d);
    touch_word |= touches ? 1u << (entry & 31u) : 0u;
    axis += touches ? texels.normal.xyz : vec3(0.0);
    ++entry;
    if ((entry & 31u) == 0u || entry >= end) {
      masks[base + (entry - 1u) / 32u] = word;
      touch_masks[base + (entry - 1u) / 32u] = touch_word;
      count += bitCount(word);
      word = 0;
      touch_word = 0;
    }
    if (entry >= end) break;
  }
  counts[item] = count;
  axes[item] = vec4(axis, 0.0);
}
