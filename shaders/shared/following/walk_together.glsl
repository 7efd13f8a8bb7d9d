// The walk of search.glsl by eight balls, for devices where eight lanes are a subgroup in lockstep: a lane loads a child of
// a node, or a triangle of a leaf, and tests it for all of the balls; triangles that are near a ball are then passed on
// to the lanes of the balls. What happens to a ball does not depend on the others. Included by search.glsl.
#ifndef MEDIAL_VK_FOLLOWING_WALK_TOGETHER_GLSL
#define MEDIAL_VK_FOLLOWING_WALK_TOGETHER_GLSL

// A ball that has met as many children and tested as many triangles, in all searches, is given up, after at most 80 more. A
// leaf that one ball meets takes up to five turns of loops, a node one, and a test two: the eight balls together take less
// than the 65,535 after which lavapipe ends all loops.
const uint kMostWork = 1500u;
const uint kMostRepeats = 8u;  // of a test

uint work = 0u;

uint own_lane() { return gl_SubgroupInvocationID & 7u; }
// A bit for each lane. (On lavapipe a ballot is a loop over the lanes.)
uint lanes_with(bool flag) { return or_of_lanes(flag ? 1u << own_lane() : 0u); }

// A node that is open: of a lane's child, the link and the balls that meet it.
uint link;
uint balls_here;
// For each level the next nodes to open: the first node below, and which of these; entries are in the lanes.
uvec2 pending;
uint level;
// Leaves of the node that wait, by lanes; and of the present leaf the lane's triangle, and the triangles near a ball.
uint waiting_leaves;
FollowTriangle own_triangle;
uint first_triangle;
uint balls_near;
uint waiting_triangles;

uint pending_at(uint i) { return from_lane(i < 8u ? pending.x : pending.y, i & 7u); }
void set_pending(uint i, uint entry) {
  pending.x = own_lane() == i ? entry : pending.x;
  pending.y = own_lane() + 8u == i ? entry : pending.y;
}

// The number of children that each lane's ball meets, from those balls that meet each lane's child.
uint count_own(uint balls) {
  uint nibbles = (balls | (balls << 12)) & 0x000f000fu;
  nibbles = (nibbles | (nibbles << 6)) & 0x03030303u;
  nibbles = (nibbles | (nibbles << 3)) & 0x11111111u;
  [[unroll]] for (uint k = 1u; k < kLanes; k <<= 1) nibbles += subgroupShuffleXor(nibbles, k);
  return (nibbles >> (4u * own_lane())) & 15u;
}

// The square of the radius; negative for a ball that meets nothing.
float squared_reach(bool is_wanted) { return is_wanted && work < kMostWork ? radius * radius : -1.0; }

// Returns the next node, or 0.
uint open_node(uint node, bool is_wanted) {
  uint place = kFollowArity * node + own_lane();
  uvec4 lower = node_vector(2u * place);
  vec3 lower_corner = uintBitsToFloat(lower.xyz), upper_corner = uintBitsToFloat(node_vector(2u * place + 1u).xyz);
  vec4 own = vec4(centre, squared_reach(is_wanted));
  balls_here = 0u;
  FOR_EACH_LANE(k) {
    vec4 ball = from_lane(own, k);
    vec3 outside = max(max(lower_corner - ball.xyz, ball.xyz - upper_corner), vec3(0.0));
    balls_here |= dot(outside, outside) < ball.w ? 1u << k : 0u;
  }
  link = lower.w;
  work += count_own(balls_here);
  uint own_bit = link >= 1u << kFollowLeafBits ? 1u << own_lane() : 256u << own_lane();
  uint met = or_of_lanes(balls_here != 0u ? own_bit : 0u);
  waiting_leaves = met & 255u;
  uint nodes_met = met >> 8;
  bool is_below = nodes_met != 0u;
  uint top = is_below ? from_lane(link, 0u) << 8 | nodes_met : pending_at(max(level, 1u) - 1u);
  level += is_below ? 1u : 0u;
  bool is_finished = level == 0u;
  uint nodes_left = top & 255u, first_left = uint(findLSB(nodes_left)), nodes_after = nodes_left & (nodes_left - 1u);
  set_pending(max(level, 1u) - 1u, (top & ~255u) | nodes_after);
  level -= !is_finished && nodes_after == 0u ? 1u : 0u;
  return is_finished ? 0u : (top >> 8) + first_left;
}

// Finds the triangles of the next leaf that may be near balls: a triangle lies in a ball around its middle, and between
// two planes across its normal.
void open_leaf(bool is_wanted) {
  uint leaf_lane = uint(findLSB(waiting_leaves | 128u));
  waiting_leaves &= waiting_leaves - 1u;
  uint leaf = from_lane(link, leaf_lane), balls = from_lane(balls_here, leaf_lane);
  uint count = leaf >> kFollowLeafBits;
  first_triangle = leaf & ((1u << kFollowLeafBits) - 1u);
  own_triangle = load_followed(first_triangle + min(own_lane(), max(count, 1u) - 1u));
  vec3 middle = (own_triangle.a.xyz + own_triangle.b.xyz + own_triangle.c.xyz) * 0.33333333;
  vec3 a = own_triangle.a.xyz - middle, b = own_triangle.b.xyz - middle, c = own_triangle.c.xyz - middle;
  vec3 normal = own_triangle.normal.xyz;
  float height = max(abs(dot(normal, a)), max(abs(dot(normal, b)), abs(dot(normal, c)))) + 2.0 * slack;
  float size = sqrt(max(dot(a, a), max(dot(b, b), dot(c, c)))) + 2.0 * slack;
  const float kSquareRounding = 1.0 - 32.0 * 1.1920929e-7;
  vec4 own = vec4(centre, squared_reach(is_wanted));
  balls_near = 0u;
  FOR_EACH_LANE(k) {
    vec4 ball = from_lane(own, k);
    vec3 d = ball.xyz - middle;
    float up = dot(d, normal);
    float above = max(abs(up) - height, 0.0);
    float beside = max(sqrt(max(kSquareRounding * dot(d, d) - up * up, 0.0)) - size, 0.0);
    balls_near |= above * above + beside * beside < ball.w ? 1u << k : 0u;
  }
  balls_near &= own_lane() < count ? balls : 0u;
  waiting_triangles = lanes_with(balls_near != 0u);
}

// Tests the next of these triangles.
void test_triangle() {
  uint lane = uint(findLSB(waiting_triangles | 128u));
  waiting_triangles &= waiting_triangles - 1u;
  FollowTriangle triangle = FollowTriangle(from_lane(own_triangle.a, lane), from_lane(own_triangle.b, lane),
                                           from_lane(own_triangle.c, lane), from_lane(own_triangle.normal, lane));
  bool is_tested = ((from_lane(balls_near, lane) >> own_lane()) & 1u) != 0u;
  uint tests = 0u;
  for (;;) {
    work += is_tested ? 1u : 0u;
    is_tested = shrinks_at(triangle, first_triangle + lane, is_tested, tests < kMostRepeats);
    if (++tests > kMostRepeats || lanes_with(is_tested) == 0u) break;
  }
}

// From the balls that at, towards and radius (or a fixed centre) describe, of those lanes that want one.
void search(bool is_wanted) {
  deficit = 0.0;
  place_ball();
  pending = uvec2(0u);
  level = 0u;
  uint node = 1u;
  for (;;) {
    for (;;) {
      node = open_node(node, is_wanted);
      if (waiting_leaves != 0u || node == 0u) break;
    }
    for (;;) {
      for (;;) {
        open_leaf(is_wanted);
        if (waiting_triangles != 0u || waiting_leaves == 0u) break;
      }
      for (;;) {
        test_triangle();
        if (waiting_triangles == 0u) break;
      }
      if (waiting_leaves == 0u) break;
    }
    if (node == 0u) break;
  }
  is_complete = work < kMostWork;
}

#endif
