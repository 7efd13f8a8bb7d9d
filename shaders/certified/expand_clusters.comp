#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Writes the kept children of parents whose lists hold clusters. The lists of the children hold triangles: those of the
// listed clusters that are contacts themselves (Lemma A with two witnesses for the ball of the child, Lemma L). One
// workgroup of eight lanes per child. Triangles dismiss more than clusters do (axis_test.glsl): a child that is found
// empty only here keeps its slot, with an empty list.
#include "lanes/lanes.glsl"
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 12
#include "tree/triangles.glsl"
#include "certified/two_axes.glsl"
#include "certified/witness.glsl"

layout(set = 0, binding = 1) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 2) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 3) readonly buffer ParentLists { uint parent_lists[]; };
layout(set = 0, binding = 4) buffer Counters { uint counters[]; };
layout(set = 0, binding = 5) readonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 6) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 7) readonly buffer Offsets { uvec4 offsets[]; };
// A lower bound of the distance from the centre (bits), and the cluster of the first witness.
layout(set = 0, binding = 8) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 9) writeonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 10) buffer Lists { uint lists[]; };
// x: between rounds, number of entries so far; z: cluster of the second witness; w: mean axis of the clusters, packed
layout(set = 0, binding = 11) buffer Counts { uvec4 counts[]; };

// The triangle of a cluster that is nearest to p, the same in all lanes.
uint nearest_of_cluster(vec3 p, uint name, uint lane) {
  uint first = clusters[name].first, last = first + clusters[name].count - 1u;
  uint best_name = first;
  float best = 3e38;
  for (uint t = first; t <= last; t += kLanes) {
    uint mine = min(t + lane, last);
    float d = squared_distance_to_triangle(p, load_triangle(mine));
    best_name = d < best ? mine : best_name;
    best = min(best, d);
    if (t + kLanes > last) break;
  }
  uint chosen = first_lane_with(best == least_of_lanes(best));
  return or_of_lanes(lane == chosen ? best_name : 0u);
}

// The set bit of a word above the k lowest ones; 31 if there are no more.
uint bit_above(uint word, uint k) {
  [[unroll]] for (uint i = 0u; i < kLanes - 1u; ++i) word &= i < k ? word - 1u : 0xffffffffu;
  return min(uint(findLSB(word)), 31u);
}

// The triangles of a cluster, a run in leaf order.
struct Run {
  uint first, count;
};

Run run_of(uint cluster) { return Run(clusters[cluster].first, clusters[cluster].count); }

// The one that lane k of the eight has loaded, of entry `list_entry`.
Run run_of_lane(Run mine, uint list_entry, uint k) {
#ifdef LOCKSTEP
  return Run(from_lane(mine.first, k), from_lane(mine.count, k));
#else
  return run_of(parent_lists[list_entry]);
#endif
}

Witness witness_of(vec3 centre, uint triangle) {
  TriangleTexels texels = load_triangle(triangle);
  Witness w = witness_at(triangle, vector_to_triangle(centre, texels));
  [[unroll]] for (uint k = 0; k < 8u; ++k)
    w.to_corner[k] = sqrt(squared_distance_to_triangle(centre + step.touch_half_side * corner_sign(k), texels));
  return w;
}

void main() {
  uint item = workgroup_index();
  uint lane = gl_LocalInvocationID.x;
  if (item >= 8u * counters[kParents] || counters[kOverflow] != 0u) return;
  uvec4 state = states[item];
  Cell parent = parents[item / 8];
  if (state.x == 0u || step.first_entry >= parent.list_count) return;
  uvec4 offset = offsets[item];
  uvec3 coordinates = child_coordinates(parent, item % 8);
  vec3 centre = cell_centre(coordinates);
  Witness front = witness_of(centre, nearest_of_cluster(centre, nearest[item].y, lane));
  Witness back =
      witness_of(centre, nearest_of_cluster(centre - step.circumradius * front.direction, counts[item].z, lane));
  bool is_inside = (state.w & kCellInside) != 0u;
  Prism prism = prism_at(front.distance, is_inside && clears_boundary(uintBitsToFloat(nearest[item].x)));
  uint word_count = (parent.list_count + 31u) / 32u;
  uint base = 8u * parent.word_begin + (item % 8) * word_count;
  uint begin = step.first_entry == 0u ? 0u : counts[item].x;
  uint position = begin, tests = 0u;
  Axes axes = axes_of(front.name, counts[item].w);
  uint end = min(word_count, (step.first_entry + step.clusters_per_round) / 32u);
  for (uint w = step.first_entry / 32u; w < end; ++w) {
    // Eight clusters at a time: each lane reads one of them.
    for (uint word = masks[base + w], first_entry = parent.list_begin + 32u * w; word != 0u;) {
      uint number = min(uint(bitCount(word)), kLanes);
      Run my_run = run_of(parent_lists[first_entry + bit_above(word, min(lane, number - 1u))]);
      for (uint i = 0u; i < number; ++i) {
        Run run = run_of_lane(my_run, first_entry + uint(findLSB(word)), i);
        for (uint k = 0u; k < run.count; k += kLanes) {
          uint t = run.first + min(k + lane, run.count - 1u);
          TriangleTexels texels = load_triangle(t);
          vec3 v = vector_to_triangle(centre, texels);
          float d = length(v);
          vec3 g = v / max(d, 1e-30);
          bool near_front = is_contact(front, d, g), near_back = is_contact(back, d, g);
          bool near_prism = is_contact(prism, v, texels.normal), is_entry = k + lane < run.count;
          bool contact = near_front && near_back && near_prism && is_entry;
          vec4 along = corners_along(step.touch_half_side * g);
          bool cube_by_front = touches_cube(front, d, along), cube_by_back = touches_cube(back, d, along);
          bool cube_by_prism = touches_cube(prism, v, texels.normal);
          bool touches = contact && cube_by_front && cube_by_back && cube_by_prism;
          axes.least = touches ? min(axes.least, cosines(axes, texels.normal)) : axes.least;
          uvec2 counted = count_lanes(contact ? 1u : 0u);
          if (contact) lists[offset.y + position + counted.x] = t;
          position += counted.y;
        }
        tests += run.count;
        word &= word - 1u;
      }
    }
  }
  bool is_all = step.first_entry == 0u && end == word_count, obeys = is_obeyed(axes, dismissal_angle(front.distance));
  bool is_empty = is_all && obeys;
  if (lane != 0u) return;
  if (is_empty) position = begin;
  counts[item].x = position;
  // The result so far: the last round completes it.
  cells[offset.x] = Cell(coordinates.x, coordinates.y, coordinates.z, parent.voxel, offset.y, position, offset.z,
                         state.w, front.name, 0u, kNoTriangle, 0u);
  // At every level with cells, the kernel that walks their lists is run, even if all lists are empty.
  atomicMax(counters[kLongestCellList], max(position, 1u));
  if (step.first_entry == 0u && !is_empty) COUNT(kKeptCount, 1u);
  COUNT(kContactCount, position - begin);
  COUNT_TESTS(tests);
}
