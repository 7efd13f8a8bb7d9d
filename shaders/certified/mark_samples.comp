#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Determines the contacts of a found voxel that may be the nearest triangle of a sample of its flux: a mask of the list
// for each of the eight groups of samples (docs/theory.md, "Samples"). One lane for each group. Lists longer than
// kEntriesPerRound take several rounds.
#include "lanes/lanes.glsl"
#include "certified/step.glsl"
#include "certified/flux_samples.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 7
#include "tree/triangles.glsl"

layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 5) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 6) buffer Work { uint work[]; };  // contacts in the mask of a group

// The distance to a triangle is convex, so it is nowhere below its tangent at the centre, w - xyz . x, here reduced by
// a bound of the rounding.
vec4 tangent_of(vec3 centre, uint name) {
  vec3 v = vector_to_triangle(centre, load_triangle(name));
  float d = length(v);
  return vec4(v / max(d, 1e-30), d - distance_slack(d, step.voxel_size));
}

// The tangent of the entry that lane k of the eight has loaded.
vec4 tangent_of_lane(vec4 mine, vec3 centre, uint list_entry, uint k) {
#ifdef LOCKSTEP
  return from_lane(mine, k);
#else
  return tangent_of(centre, lists[list_entry]);
#endif
}

void main() {
  uint index = invocation_index(), group = index % kGroupsPerSphere;
  uint item = step.first_item + index / kGroupsPerSphere;
  if (item >= counters[kFound]) return;
  Cell cell = cells[found[item].cell];
  uint entry = step.first_entry;
  if (entry >= cell.list_count) return;

  vec3 centre = voxel_centre(found[item]);
  TriangleTexels first = load_triangle(cell.nearest);
  TriangleTexels second = load_triangle(cell.partner == kNoTriangle ? cell.nearest : cell.partner);
  vec3 away[kFluxGroup];
  float limit[kFluxGroup];  // the nearest triangle is no farther
  [[unroll]] for (uint i = 0; i < kFluxGroup; ++i) {
    vec3 p = sample_point(centre, sample_of_group(group, i));
    away[i] = p - centre;
    limit[i] = sqrt(min(squared_distance_to_triangle(p, first), squared_distance_to_triangle(p, second)));
  }
  uint end = min(cell.list_count, entry + kEntriesPerRound), last = cell.list_begin + end - 1u;
  uint base = sample_mask_begin(cell, group), word = 0u, count = entry == 0u ? 0u : work[index];
  while (entry < end) {
    uint next = cell.list_begin + entry;
    vec4 mine = tangent_of(centre, lists[min(next + group, last)]);
    FOR_EACH_LANE(k) {
      vec4 tangent = tangent_of_lane(mine, centre, min(next + k, last), k);
      bool listed = false;
      [[unroll]] for (uint i = 0; i < kFluxGroup; ++i) {
        bool is_near = tangent.w - dot(tangent.xyz, away[i]) <= limit[i];
        listed = listed || is_near;
      }
      bool is_entry = entry + k < end;
      word |= listed && is_entry ? 1u << (entry + k & 31u) : 0u;
    }
    entry += kLanes;
    if ((entry & 31u) == 0u || entry >= end) {
      masks[base + (min(entry, end) - 1u) / 32u] = word;
      count += bitCount(word);
      word = 0u;
    }
    if (entry >= end) break;
  }
  work[index] = count;
  if (group == 0u) COUNT_TESTS(end - step.first_entry);
}
