// The walk of search.glsl by eight balls, for devices where eight lanes are a subgroup in lockstep: a lane loads a child of
// a node, or a triangle of a leaf, and passes its bounds on to all balls, which are in the lanes, too; then each ball
// takes those triangles that are near it, one after the other. What happens to a ball does not depend on the others.
// Included by search.glsl.
#ifndef MEDIAL_VK_FOLLOWING_WALK_TOGETHER_GLSL
#define MEDIAL_VK_FOLLOWING_WALK_TOGETHER_GLSL

// A ball that has met as many children and tested as many triangles, in all searches, is given up, after at most 584 more:
// the eight children of a node, and nine tests of each of 64 triangles. A node or a test that one ball needs takes up to
// two turns of loops, a leaf one: the eight balls together take at most 33,344 and a few for each search, less than the
// 65,535 after which lavapipe ends all loops.
const uint kMostWork = 1500u;
const uint kMostRepeats = 8u;  // of a test

uint work = 0u;

uint own_lane() { return gl_SubgroupInvocationID & 7u; }

// A node that is open: the link of a lane's child, and the children that the lane's ball meets.
uint link;
uint children_met;
// For each level the next nodes to open: the first node below, and which of these; entries are in the lanes.
uvec2 pending;
uint level;
// Leaves of the node that wait, by lanes; and the triangles of its leaves that are near the lane's ball, eight bits for
// each leaf.
uint waiting_leaves;
uvec2 triangles_near;

uint pending_at(uint i) { return from_lane(i < 8u ? pending.x : pending.y, i & 7u); }
void set_pending(uint i, uint entry) {
  pending.x = own_lane() == i ? entry : pending.x;
  pending.y = own_lane() + 8u == i ? entry : pending.y;
}

// The square of the radius; negative for a ball that meets nothing.
float squared_reach(bool is_wanted) {
  return is_wanted && work < kMostWork && radius > least_wanted ? radius * radius : -1.0;
}

// Returns the next node, or 0.
uint open_node(uint node, bool is_wanted) {
  uint place = kFollowArity * node + own_lane();
  uvec4 lower = node_vector(2u * place);
  vec3 lower_corner = uintBitsToFloat(lower.xyz), upper_corner = uintBitsToFloat(node_vector(2u * place + 1u).xyz);
  float reach = squared_reach(is_wanted);
  children_met = 0u;
  FOR_EACH_LANE(k) {
    // One of both is 0; a greatest number of two that may be no numbers would take longer.
    vec3 below = from_lane(lower_corner, k) - centre, above = centre - from_lane(upper_corner, k);
    vec3 outside = max(below, vec3(0.0)) + max(above, vec3(0.0));
    children_met |= dot(outside, outside) < reach ? 1u << k : 0u;
  }
  link = lower.w;
  work += uint(bitCount(children_met));
  uint own_leaf = link >= 1u << kFollowLeafBits ? 256u << own_lane() : 0u;
  uint of_all = or_of_lanes(children_met | own_leaf), leaves = of_all >> 8;
  waiting_leaves = of_all & 255u & leaves;
  uint nodes_met = of_all & 255u & ~leaves;
  bool is_below = nodes_met != 0u;
  uint top = is_below ? from_lane(link, 0u) << 8 | nodes_met : pending_at(max(level, 1u) - 1u);
  level += is_below ? 1u : 0u;
  bool is_finished = level == 0u;
  uint nodes_left = top & 255u, first_left = uint(findLSB(nodes_left)), nodes_after = nodes_left & (nodes_left - 1u);
  set_pending(max(level, 1u) - 1u, (top & ~255u) | nodes_after);
  level -= !is_finished && nodes_after == 0u ? 1u : 0u;
  return is_finished ? 0u : (top >> 8) + first_left;
}

// Finds the triangles of the next leaf that may be near the lane's ball: a triangle lies in a ball around its middle, and
// between two planes across its normal.
void open_leaf(float reach) {
  uint leaf_lane = uint(findLSB(waiting_leaves | 128u));
  waiting_leaves &= waiting_leaves - 1u;
  uint leaf = from_lane(link, leaf_lane), count = leaf >> kFollowLeafBits;
  uint triangle = (leaf & ((1u << kFollowLeafBits) - 1u)) + min(own_lane(), max(count, 1u) - 1u);
  vec4 own_ball = bounds_of(triangle) + vec4(vec3(0.0), 2.0 * slack);
  vec4 own_planes = triangle_vector(4u * triangle + 3u) + vec4(vec3(0.0), 2.0 * slack);
  const float kSquareRounding = 1.0 - 32.0 * 1.1920929e-7;
  uint near = 0u;
  FOR_EACH_LANE(k) {
    vec4 around = from_lane(own_ball, k), planes = from_lane(own_planes, k);
    vec3 d = centre - around.xyz;
    float up = dot(d, planes.xyz);
    float above = max(abs(up) - planes.w, 0.0);
    float beside = max(sqrt(max(kSquareRounding * dot(d, d) - up * up, 0.0)) - around.w, 0.0);
    near |= above * above + beside * beside < reach ? 1u << k : 0u;
  }
  near = (children_met >> leaf_lane & 1u) != 0u ? near & ((1u << count) - 1u) : 0u;
  near <<= 8u * (leaf_lane & 3u);
  triangles_near |= leaf_lane < 4u ? uvec2(near, 0u) : uvec2(0u, near);
}

// Tests the triangles near each ball: those of different balls at the same time.
void test_triangles() {
  uint tests = 0u;
  for (;;) {
    bool is_first = triangles_near.x != 0u, is_tested = is_first || triangles_near.y != 0u;
    uint next = is_first ? triangles_near.x : triangles_near.y, bit = uint(findLSB(next | 1u << 31));
    uint leaf = from_lane(link, (bit >> 3) + (is_first ? 0u : 4u));
    uint triangle = is_tested ? (leaf & ((1u << kFollowLeafBits) - 1u)) + (bit & 7u) : 0u;
    work += is_tested ? 1u : 0u;
    bool again = shrinks_at(load_followed(triangle), triangle, is_tested, tests < kMostRepeats);
    tests = again ? tests + 1u : 0u;
    next = again ? next : next & (next - 1u);
    triangles_near = is_first ? uvec2(next, triangles_near.y) : uvec2(0u, next);
    if (or_of_lanes(triangles_near.x | triangles_near.y) == 0u) break;
  }
}

// lavapipe runs the body of a loop to its end at least once, so that what is seldom needed comes after a loop that ends
// where it is. From the balls that at, towards and radius (or a fixed centre) describe, of those lanes that want one.
void search(bool is_wanted) {
  deficit = 0.0;
  place_ball();
  pending = uvec2(0u);
  level = 0u;
  triangles_near = uvec2(0u);
  uint node = 1u;
  for (;;) {
    for (;;) {
      for (;;) {
        node = open_node(node, is_wanted);
        if (waiting_leaves != 0u || node == 0u) break;
      }
      for (;;) {
        open_leaf(squared_reach(is_wanted));
        if (waiting_leaves == 0u) break;
      }
      if (node == 0u || or_of_lanes(triangles_near.x | triangles_near.y) != 0u) break;
    }
    test_triangles();
    if (node == 0u) break;
  }
  is_complete = work < kMostWork && !(radius <= least_wanted);
}

#endif
