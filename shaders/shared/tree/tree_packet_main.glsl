// The kernel of find_closest_in_packets*.comp.
#define QUERY_STORAGE_BUFFERS 11
#define COUNTS_CONSTANT 4
#include "tree/tree_query.glsl"
#include "tree/closest_result.glsl"
#define FRAME_STORAGE_BINDING 8
#define FRAME_TEXEL_BINDING (QUERY_STORAGE_BUFFERS + 2)
#include "tree/triangle_frame.glsl"
#include "tree/tree_packet.glsl"

layout(set = 0, binding = 9) readonly buffer Slots { uint slots[]; };

layout(set = 0, binding = 10) readonly buffer LeafPositions { uint leaf_positions[]; };  // by index of the input

uint found_position(uint rank) {
  if (rank == 0u) return kNoHit;
  return kSmallestIndex ? leaf_positions[rank - 1u] : rank - 1u;
}

uint group_count() { return push.items_counter == kNoCounter ? push.items : counters[push.items_counter]; }

void main() {
  uint group_size = push.items_multiplier, packet_slots = kPerLane * gl_WorkGroupSize.x;
  uint packets = uint(slots.length()) / packet_slots;  // of a group
  uint group = group_index() / packets;
  if (group >= group_count()) return;
  uint first_slot = group_index() % packets * packet_slots + kPerLane * team_lane();
  uint query_of[kPerLane];  // query + 1, 0: none
  FOR_EACH_POINT {
    uint index = slots[first_slot + k];
    uint query = group * group_size + min(index, group_size - 1u);
    vec4 q = queries[query];
    points[k] = q.xyz;
    best[k] = index < group_size ? q.w : -1.0;
    query_of[k] = best[k] >= 0.0 ? query + 1u : 0u;
    found[k] = 0u;
  }
  enclose_packet();
  update_bound();
  bool complete = team_is_whole() && walk_packet();
  // One lane reports for all about nodes and balls around packets, and each lane about its own points.
  uint queried_points = 0u;
  FOR_EACH_POINT queried_points += uint(query_of[k] != 0u);
  tested_triangles = queried_points * triangles_for_points + (team_lane() == 0u ? triangles_for_packet : 0u);
  tested_nodes = team_lane() == 0u ? tested_nodes : 0u;
  count_tests();
  FOR_EACH_POINT {
    if (query_of[k] != 0u && complete) write_hit(query_of[k] - 1u, points[k], found_position(found[k]));
    if (query_of[k] != 0u && !complete) leave_unresolved(query_of[k] - 1u);
  }
}
