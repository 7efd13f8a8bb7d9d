// Nearest triangles of a packet of points near each other, by one team (packet_team.glsl) in one walk of the wide tree:
// every node and triangle is loaded once for all points. A lane keeps kPerLane points. Lanes test the children of a
// node, or the triangles of a leaf, against the ball around the packet; the remaining ones are tested against every
// point. Include tree_query.glsl, closest_result.glsl and triangle_frame.glsl before.
//
// A node of the wide tree is two texels for each of kArity children, as in tree.glsl; a count of -1: no child.
#include "tree/packet_team.glsl"

layout(constant_id = 1) const bool kSmallestIndex = false;  // among exact ties; else the smallest leaf position
layout(constant_id = 2) const uint kPerLane = 7u;
layout(constant_id = 3) const uint kArity = 8u;

const float kPreferFaces = 1.0 - 9.5367e-7;  // as in tree_closest.glsl
// A level leaves at most kArity - 1 children behind, and no tree is deeper than kStackSize.
const uint kPacketStack = 7u * kStackSize + 8u;
// Loop iterations after which the packet gives up; between two checks of the count the stack may be emptied once.
const uint kMostIterations = 64000u - 2u * kPacketStack;

shared uvec2 stack[kPacketStack];  // child (kArity * node + its number), squared distance from the packet's centre

#define FOR_EACH_POINT [[unroll]] for (uint k = 0u; k < kPerLane; ++k)

vec3 points[kPerLane];
float best[kPerLane];  // squared distances; negative: no point here, so that nothing is nearer
uint found[kPerLane];  // rank + 1; 0: none yet. Ranks are leaf positions, or input indices if these decide ties
vec3 centre;
float radius;
float bound;  // squared: beyond it from the centre, nothing can be nearest to any point
uint stack_size;
uint iterations;
// Tested against the ball around the packet, and against every point.
uint triangles_for_packet = 0u, triangles_for_points = 0u;

// Radius of the ball around the packet that meets everything that may be nearest to a point. 1e-6: the bound and the
// distances compared with it are rounded some ten times.
void update_bound() {
  float greatest = best[0];
  FOR_EACH_POINT greatest = greater(greatest, best[k]);
  float reach = sqrt(max(team_max(greatest), 0.0)) + radius;
  bound = reach * reach * (1.0 + 2e-6);
}

float squared_distance_to_box_fast(vec3 p, vec3 lower, vec3 upper) {
  vec3 d = p - vec3(lesser(greater(p.x, lower.x), upper.x), lesser(greater(p.y, lower.y), upper.y),
                    lesser(greater(p.z, lower.z), upper.z));
  return dot(d, d);
}

// True if a point of this lane may be nearest to something in a box.
bool box_is_near(vec3 lower, vec3 upper) {
  bool near = false;
  FOR_EACH_POINT near = near || squared_distance_to_box_fast(points[k], lower, upper) <= best[k];
  return near;
}

// Takes the next position from the stack that is relevant to any point.
uint pop_position() {
  uint position = kFinished;
  for (;;) {
    bool finished;
    uvec2 entry;
    for (;;) {
      finished = stack_size == 0u;
      stack_size -= uint(!finished);
      entry = finished ? uvec2(0u) : stack[stack_size];
      ++iterations;
      if (finished || uintBitsToFloat(entry.y) <= bound) break;
    }
    vec4 lower = tree_texel(2u * entry.x), upper = tree_texel(2u * entry.x + 1u);
    bool near = box_is_near(lower.xyz, upper.xyz);
    position = finished ? kFinished : tree_position(lower, upper);
    tested_nodes += finished ? 0u : 1u;
    ++iterations;
    if (finished || team_any(near)) break;
  }
  return position;
}

// Children of a node that the packet's ball meets are pushed onto the stack, the nearest last.
void push_children(uint node) {
  uint lane = team_lane(), child = kArity * node + lane % kArity;
  vec4 lower = tree_texel(2u * child), upper = tree_texel(2u * child + 1u);
  float d = squared_distance_to_box_fast(centre, lower.xyz, upper.xyz);
  bool hit = lane < kArity && upper.w >= 0.0 && d <= bound;
  float key = hit ? d : -1.0;
  uint rank = 0u;
  [[unroll]] for (uint i = 0u; i < kArity; ++i) {
    float other = team_read(key, i);
    rank += uint(other > key || (other == key && i < lane));
  }
  uint count = bitCount(team_ballot(hit));
  if (hit) stack[stack_size + rank] = uvec2(child, floatBitsToUint(d));
  team_barrier();
  stack_size += count;
  tested_nodes += kArity;
  iterations += 1u;
}

void test_triangle(TriangleFrame frame, uint position) {
  uint rank = (kSmallestIndex ? uint(frame.n.w) : position) + 1u;
  FOR_EACH_POINT {
    float d = squared_distance_to_frame(points[k], frame, kPreferFaces);
    bool nearer = d < best[k] || (d == best[k] && rank < found[k]);
    best[k] = nearer ? d : best[k];
    found[k] = nearer ? rank : found[k];
  }
}

void test_leaf(uint position) {
  uint first = position & kFirstMask, count = position >> 24, lane = team_lane();
  for (uint start = 0u;;) {
    uint last = min(count - start, kArity) - 1u;
    TriangleFrame own = load_frame(first + start + min(lane % kArity, last));
    float d = squared_distance_to_frame(centre, own, 1.0);
    uint waiting = team_ballot(lane <= last && lane < kArity && d <= bound);
    triangles_for_packet += last + 1u;
    for (;;) {
      uint i = min(uint(findLSB(waiting)), last);  // if none is left: one useless test
      waiting &= waiting - 1u;
      ++triangles_for_points;
      TriangleFrame frame =
          TriangleFrame(team_read(own.a, i), team_read(own.t, i), team_read(own.s, i), team_read(own.n, i),
                        team_read(own.edges, i));
      test_triangle(frame, first + start + i);
      ++iterations;
      if (waiting == 0u) break;
    }
    start += kArity;
    ++iterations;
    if (start >= count) break;
  }
  update_bound();
}

// False if the budget was spent first.
bool walk_packet() {
  stack_size = 0u;
  iterations = 100u;  // for the loops that are not counted
  uint position = 0u;
  for (;;) {
    for (;;) {
      push_children(position);
      position = pop_position();
      if (position >= kLeaf || iterations >= kMostIterations) break;
    }
    if (position == kFinished || iterations >= kMostIterations) break;
    for (;;) {
      test_leaf(position);
      position = pop_position();
      if (!is_leaf(position) || iterations >= kMostIterations) break;
    }
    ++iterations;
    if (position == kFinished || iterations >= kMostIterations) break;
  }
  return position == kFinished;
}

// The smallest box around the points, as a ball. Lanes without points use those of others.
void enclose_packet() {
  const float kInfinity = 3e38;
  vec3 lower = vec3(kInfinity), upper = vec3(-kInfinity);
  FOR_EACH_POINT {
    lower = best[k] >= 0.0 ? min(lower, points[k]) : lower;
    upper = best[k] >= 0.0 ? max(upper, points[k]) : upper;
  }
  lower = -vec3(team_max(-lower.x), team_max(-lower.y), team_max(-lower.z));
  upper = vec3(team_max(upper.x), team_max(upper.y), team_max(upper.z));
  centre = 0.5 * (lower + upper);
  float farthest = 0.0;
  FOR_EACH_POINT farthest = best[k] >= 0.0 ? max(farthest, distance(points[k], centre)) : farthest;
  radius = team_max(farthest) * (1.0 + 1e-6);
}
