#version 450
#extension GL_GOOGLE_include_directive : enable
// Which of a parent's contacts are contacts of each child: Lemma A (docs/theory.md). One invocation per parent and
// child; one bit per list entry.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 8
#include "triangles.glsl"

layout(set = 0, binding = 1) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 6) buffer Counts { uint counts[]; };
layout(set = 0, binding = 7) buffer Axes { vec4 axes[]; };  // sum of the contacts' normals: a first axis to try

void main() {
  uint item = invocation_index();
  if (item >= 8u * counters[kParents]) return;
  Cell parent = parents[item / 8];
  uint child = item % 8;
  uint entry = step.first_entry;
  if (entry >= parent.list_count) return;
  vec3 centre = cell_centre(child_coordinates(parent, child));
  vec3 to_nearest = vector_to_triangle(centre, load_triangle(nearest[item].y));
  float nearest_distance = length(to_nearest);
  vec3 nearest_direction = unit_or_zero(to_nearest);
  float radius = step.list_radius;
  bool far = nearest_distance > radius;
  // dist(m, nearest) <= D0 - g0.x + |x|^2 / (2 D0): what curvature of the distance to a point adds.
  float bend = far ? radius * radius / (2.0 * nearest_distance) : 0.0;
  uint end = min(parent.list_count, entry + kEntriesPerRound);
  uint word_count = (parent.list_count + 31u) / 32u;
  uint base = 8u * parent.word_begin + child * word_count;
  uint count = entry == 0 ? 0u : counts[item];
  vec3 axis = entry == 0 ? vec3(0.0) : axes[item].xyz;
  uint word = 0;
  for (;;) {
    TriangleTexels texels = load_triangle(lists[parent.list_begin + entry]);
    vec3 v = vector_to_triangle(centre, texels);
    float d = length(v);
    float excess = d - nearest_distance - 6.0 * step.slack;  // docs/theory.md, "Rounding"
    float reach = far ? radius * length(v / max(d, 1e-30) - nearest_direction) + bend : 2.0 * radius;
    bool contact = excess <= reach;
    word |= contact ? 1u << (entry & 31u) : 0u;
    axis += contact ? texels.normal.xyz : vec3(0.0);
    ++entry;
    if ((entry & 31u) == 0u || entry >= end) {
      masks[base + (entry - 1u) / 32u] = word;
      count += bitCount(word);
      word = 0;
    }
    if (entry >= end) break;
  }
  counts[item] = count;
  axes[item] = vec4(axis, 0.0);
}
