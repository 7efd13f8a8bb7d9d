#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Writes the contact lists of the top cells, which hold clusters: Lemma A for the box of every cluster, with one
// witness for the ball of the list, the known point that is nearest to the centre. One invocation per cell; eight of
// them walk over all clusters together. Run twice: to count, then, without the cells that lie outside, to write
// (step.second_task).
#include "lanes/lanes.glsl"
#include "certified/step.glsl"
#include "certified/witness.glsl"
#define CLUSTER_TEXEL_BINDING 6
#include "certified/cluster_texels.glsl"

layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) buffer States { uvec4 states[]; };
layout(set = 0, binding = 2) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 3) buffer Nearest { uvec2 nearest[]; };  // y: the cluster of the witness
layout(set = 0, binding = 4) writeonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 5) writeonly buffer Lists { uint lists[]; };

// One vec4 of `cluster`, which lane k of the eight has loaded.
vec3 texel_of_lane(vec4 mine, uint cluster, uint which, uint k) {
#ifdef LOCKSTEP
  return from_lane(mine, k).xyz;
#else
  return cluster_texel(cluster, which).xyz;
#endif
}

// The first cluster whose known point is nearest to the centre.
uint find_witness(vec3 centre) {
  uint lane = gl_LocalInvocationID.x, last = step.cluster_count - 1u, best_name = 0u;
  float best = 3e38;
  for (uint first = 0u; first <= last;) {
    vec4 mine = cluster_texel(min(first + lane, last), kClusterPoint);
    FOR_EACH_LANE(k) {
      uint name = min(first + k, last);
      vec3 v = texel_of_lane(mine, name, kClusterPoint, k) - centre;
      float squared = dot(v, v);
      best_name = squared < best ? name : best_name;
      best = min(best, squared);
    }
    first += kLanes;
    if (first > last) break;
  }
  return best_name;
}

// Mask of the listed clusters among the 32 from `first` on, and a lower bound of the distance to them all.
uint listed_from(uint first, vec3 centre, Witness witness, inout float clearance) {
  uint lane = gl_LocalInvocationID.x, last = step.cluster_count - 1u, word = 0u;
  for (uint begin = 0u; begin < 32u;) {
    uint mine = min(first + begin + lane, last);
    vec4 my_lower = cluster_texel(mine, kClusterLower), my_upper = cluster_texel(mine, kClusterUpper);
    FOR_EACH_LANE(k) {
      uint name = min(first + begin + k, last);
      vec3 lower = texel_of_lane(my_lower, name, kClusterLower, k);
      vec3 upper = texel_of_lane(my_upper, name, kClusterUpper, k);
      vec3 v = max(lower - centre, vec3(0.0)) + min(upper - centre, vec3(0.0));
      float d = length(v);
      bool is_near = is_contact(witness, d, v / max(d, 1e-30)), is_cluster = first + begin + k <= last;
      word |= is_near && is_cluster ? 1u << (begin + k) : 0u;
      clearance = min(clearance, d);
    }
    begin += kLanes;
    if (begin >= 32u || first + begin > last) break;
  }
  return word;
}

// Lanes beyond the last cell walk with the others.
void main() {
  uint item = invocation_index();
  if (item - gl_LocalInvocationID.x >= counters[kParents]) return;  // the same for the whole workgroup
  bool exists = item < counters[kParents], writes = step.second_task != 0u;
  bool is_kept = exists && writes && states[item].x != 0u;
  uvec3 coordinates = top_cell_coordinates(step.first_item + item);
  vec3 centre = cell_centre(coordinates);
  uint name = writes ? min(nearest[item].y, step.cluster_count - 1u) : find_witness(centre);
  Witness witness = witness_at(name, cluster_texel(name, kClusterPoint).xyz - centre);
  uvec4 offset = offsets[item];
  uint total = 0u;
  float clearance = 3e38;
  for (uint first = 0u; first < step.cluster_count;) {
    uint word = listed_from(first, centre, witness, clearance), position = offset.y + total;
    total += bitCount(word);
    word = is_kept ? word : 0u;
    while (word != 0u) {
      lists[position] = first + uint(findLSB(word));
      ++position;
      word &= word - 1u;
    }
    first += 32u;
    if (first >= step.cluster_count) break;
  }
  if (exists && !writes) {
    nearest[item].y = name;
    // decide_side.comp replaces the clearance by flags.
    states[item] = uvec4(1u, total, (total + 31u) / 32u, ordered_bits(clearance));
  }
  if (!is_kept) return;
  cells[offset.x] = Cell(coordinates.x, coordinates.y, coordinates.z, 0u, offset.y, total, offset.z, states[item].w, 0u,
                         0u, kNoTriangle, 0u);
  atomicMax(counters[kLongestCellList], total);
}
