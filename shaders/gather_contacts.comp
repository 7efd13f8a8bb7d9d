#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The contact lists of the top cells, of clusters or of their triangles. One workgroup per cell keeps the clusters that
// may hold the nearest triangle of some point of the cell's ball, by their boxes: with U an upper bound of the distance
// from the centre to the mesh, those no farther than U + 2R. Each lane looks at one run of clusters, so that lists are in
// order. Run twice: to count, then, without the cells that
// lie outside, to write.
#include "lanes.glsl"
#include "step.glsl"

layout(constant_id = 1) const bool kWrite = false;

layout(set = 0, binding = 0) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 5) writeonly buffer Lists { uint lists[]; };

float nearest_in_box(vec3 p, Cluster c) { return length(max(max(c.lower.xyz - p, p - c.upper.xyz), vec3(0.0))); }
float farthest_in_box(vec3 p, Cluster c) { return length(max(p - c.lower.xyz, c.upper.xyz - p)); }

uint entries_of(Cluster c) { return step.lists != kListsTriangles ? 1u : c.count; }

// Of eight lanes each; floats as bits, which are in the same order where they are positive.
const uint kMostEights = kMostLanes / kLanes;
shared uint count_of_eight[kMostEights];
shared uint least_bound, least_clearance;

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

void main() {
  uint item = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint lane = gl_LocalInvocationID.x, lanes = gl_WorkGroupSize.x;
  uint cluster_count = step.cluster_count;
  bool exists = item < counters[kParents];
  uvec3 coordinates = top_cell_coordinates(step.first_item + item);
  vec3 centre = cell_centre(coordinates);
  if (lane == 0u) {
    least_bound = 0x7f800000u;
    least_clearance = 0x7f800000u;
  }
  barrier();
  float bound = 3e38, clearance = bound;
  for (uint i = lane; i < cluster_count; i += lanes) {
    bound = min(bound, farthest_in_box(centre, clusters[i]));
    clearance = min(clearance, nearest_in_box(centre, clusters[i]));
  }
  bound = least_of_lanes(bound);
  clearance = least_of_lanes(clearance);
  if (lane % kLanes == 0u) {
    atomicMin(least_bound, floatBitsToUint(bound));
    atomicMin(least_clearance, floatBitsToUint(clearance));
  }
  barrier();
  float reach = uintBitsToFloat(least_bound) + 2.0 * step.list_radius + step.slack;
  uint run = (cluster_count + lanes - 1u) / lanes;
  uint begin = min(cluster_count, lane * run), end = min(cluster_count, begin + run);
  uint count = 0;
  for (uint i = begin; i < end; ++i) count += nearest_in_box(centre, clusters[i]) <= reach ? entries_of(clusters[i]) : 0u;
  uvec2 place = count_all_lanes(count);
  uint total = place.y;
  if (!exists) return;
  if (!kWrite) {
    // decide_side.comp replaces the clearance by flags.
    if (lane == 0u) states[item] = uvec4(1u, total, (total + 31u) / 32u, least_clearance);
    return;
  }
  uvec4 state = states[item], offset = offsets[item];
  if (state.x == 0u) return;
  if (lane == 0u) {
    cells[offset.x] = Cell(coordinates.x, coordinates.y, coordinates.z, 0u, offset.y, total, offset.z, state.w, 0u, 0u,
                           0u, 0u);
    atomicMax(counters[kLongestCellList], total);
  }
  uint position = offset.y + place.x;
  for (uint i = begin; i < end; ++i) {
    Cluster c = clusters[i];
    if (nearest_in_box(centre, c) > reach) continue;
    uint entries = entries_of(c), first = step.lists != kListsTriangles ? i : c.first;
    // Four an iteration: lavapipe counts them (DeviceMesh::kMostTriangles).
    for (uint k = 0; k < entries; k += 4u) {
      [[unroll]] for (uint j = 0; j < 4u; ++j)
        if (k + j < entries) lists[position + k + j] = first + k + j;
    }
    position += entries;
  }
}
