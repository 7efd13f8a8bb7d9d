#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The contact lists of the top cells, of clusters or of their triangles: Lemma A for the box of every cluster, with one
// witness for the ball of the list, the known point that is nearest to the centre. One workgroup per cell. Each lane
// looks at one run of clusters, so that lists are in order. Run twice: to count, then, without the cells that lie
// outside, to write (step.second_task).
#include "lanes.glsl"
#include "step.glsl"
#include "witness.glsl"

layout(set = 0, binding = 0) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) buffer Nearest { uvec2 nearest[]; };  // y: the cluster of the witness
layout(set = 0, binding = 5) writeonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 6) writeonly buffer Lists { uint lists[]; };

vec3 vector_to_box(vec3 p, uint cluster) {
  return max(clusters[cluster].lower.xyz - p, vec3(0.0)) + min(clusters[cluster].upper.xyz - p, vec3(0.0));
}

bool is_listed(Witness witness, vec3 centre, uint cluster) {
  vec3 v = vector_to_box(centre, cluster);
  float d = length(v);
  return is_contact(witness, d, v / max(d, 1e-30));
}

uint entries_of(uint cluster) { return step.lists != kListsTriangles ? 1u : clusters[cluster].count; }

// Of eight lanes each; numbers as ordered_bits().
const uint kMostEights = kMostLanes / kLanes;
shared uint count_of_eight[kMostEights];
shared uint least_distance, least_clearance, first_nearest;

// Of the entries of all lanes, how many those of the lanes before this one have, and how many there are.
uvec2 count_all_lanes(uint mine) {
  uint lane = gl_LocalInvocationID.x, eight = lane / kLanes;
  uvec2 place = count_lanes(mine);
  if (lane % kLanes == 0u) count_of_eight[eight] = place.y;
  barrier();
  place.y = 0u;
  for (uint i = 0; i < gl_WorkGroupSize.x / kLanes; ++i) {
    place.x += i < eight ? count_of_eight[i] : 0u;
    place.y += count_of_eight[i];
  }
  return place;
}

// The first cluster whose known point is nearest to the centre; on the way, a lower bound of the distance to them all.
uint find_witness(vec3 centre) {
  uint lane = gl_LocalInvocationID.x, name = 0xffffffffu;
  if (lane == 0u) least_distance = least_clearance = first_nearest = 0xffffffffu;
  barrier();
  float distance_here = 3e38, clearance = 3e38;
  for (uint i = lane; i < step.cluster_count; i += gl_WorkGroupSize.x) {
    float d = length(clusters[i].point.xyz - centre);
    name = d < distance_here ? i : name;
    distance_here = min(distance_here, d);
    clearance = min(clearance, length(vector_to_box(centre, i)));
  }
  atomicMin(least_distance, ordered_bits(distance_here));
  atomicMin(least_clearance, ordered_bits(clearance));
  barrier();
  if (ordered_bits(distance_here) == least_distance) atomicMin(first_nearest, name);
  barrier();
  return first_nearest;
}

void main() {
  uint item = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint lane = gl_LocalInvocationID.x, lanes = gl_WorkGroupSize.x;
  bool writes = step.second_task != 0u;
  if (item >= counters[kParents] || (writes && states[item].x == 0u)) return;  // all lanes of the workgroup
  uvec3 coordinates = top_cell_coordinates(step.first_item + item);
  vec3 centre = cell_centre(coordinates);
  uint name = writes ? nearest[item].y : find_witness(centre);
  Witness witness = witness_at(name, clusters[name].point.xyz - centre);
  uint run = (step.cluster_count + lanes - 1u) / lanes;
  uint begin = min(step.cluster_count, lane * run), end = min(step.cluster_count, begin + run);
  uint count = 0;
  for (uint i = begin; i < end; ++i) count += is_listed(witness, centre, i) ? entries_of(i) : 0u;
  uvec2 place = count_all_lanes(count);
  uint total = place.y;
  if (!writes) {
    if (lane != 0u) return;
    nearest[item].y = name;
    // decide_side.comp replaces the clearance by flags.
    states[item] = uvec4(1u, total, (total + 31u) / 32u, least_clearance);
    return;
  }
  uvec4 offset = offsets[item];
  if (lane == 0u) {
    cells[offset.x] = Cell(coordinates.x, coordinates.y, coordinates.z, 0u, offset.y, total, offset.z,
                           states[item].w, 0u, 0u, kNoTriangle, 0u);
    atomicMax(counters[kLongestCellList], total);
  }
  uint position = offset.y + place.x;
  for (uint i = begin; i < end; ++i) {
    if (!is_listed(witness, centre, i)) continue;
    uint entries = entries_of(i), first = step.lists != kListsTriangles ? i : clusters[i].first;
    // Four an iteration: lavapipe counts them (DeviceMesh::kMostTriangles).
    for (uint k = 0; k < entries; k += 4u) {
      [[unroll]] for (uint j = 0; j < 4u; ++j)
        if (k + j < entries) lists[position + k + j] = first + k + j;
    }
    position += entries;
  }
}
