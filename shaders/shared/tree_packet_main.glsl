// The kernel of find_closest_in_packets*.comp.
#define QUERY_STORAGE_BUFFERS 9
#include "tree_query.glsl"
#include "closest_result.glsl"
#define FRAME_STORAGE_BINDING 8
#define FRAME_TEXEL_BINDING (QUERY_STORAGE_BUFFERS + 2)
#include "triangle_frame.glsl"
#include "tree_packet.glsl"

uint group_count() { return push.items_counter == kNoCounter ? push.items : counters[push.items_counter]; }

void main() {
  uint group_size = push.items_multiplier, slots = kPerLane * gl_WorkGroupSize.x;
  uint packets = (group_size + slots - 1u) / slots;  // of a group, all of about the same size
  uint size = (group_size + packets - 1u) / packets;
  uint group = group_index() / packets, start = group_index() % packets * size;
  if (group >= group_count() || start >= group_size) return;
  uint first = group * group_size + start, count = min(size, group_size - start);
  FOR_EACH_POINT {
    uint i = k * gl_WorkGroupSize.x + team_lane();
    vec4 q = queries[first + min(i, count - 1u)];
    points[k] = q.xyz;
    best[k] = i < count ? q.w : -1.0;
    found[k] = 0u;
    found_index[k] = 0u;
  }
  enclose_packet();
  update_bound();
  bool complete = team_is_whole() && walk_packet();
  FOR_EACH_POINT {
    uint i = k * gl_WorkGroupSize.x + team_lane();
    bool asked = i < count && queries[first + min(i, count - 1u)].w >= 0.0;
    if (asked && complete) write_hit(first + i, points[k], found[k] - 1u);
    if (asked && !complete) leave_unresolved(first + i);
  }
}
