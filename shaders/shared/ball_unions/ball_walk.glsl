// The balls that cut the cell of one ball: first its neighbours in the order of the tree, then those that the tree
// yields. Include clip_power_cell.glsl before.
#ifndef MEDIAL_VK_BALL_WALK_GLSL
#define MEDIAL_VK_BALL_WALK_GLSL

layout(set = 0, binding = 0) readonly buffer Balls { SplitBall balls[]; };
layout(set = 0, binding = 1) readonly buffer Names { uint names[]; };  // indices of the balls on the host
layout(set = 0, binding = 2) readonly buffer Nodes { BallNode nodes[]; };

const float kSplitRounding = 1.4210855e-14;  // 2^-46: of a difference of two numbers up to 1, from two parts

uint own;          // the cell's ball
vec4 own_high, own_middle;
float own_radius;
float own_unit;    // 1 / radius

bool walk_is_over() { return cell_is_empty || cell_failed || spent > push.iterations; }

// Of balls with the same centre the larger one keeps the whole cell, and of equal ones the first. Numbers are equal if
// all their parts are equal, and compare as their parts do.
void test_concentric(uint j) {
  SplitBall mine = balls[own], other = balls[j];
  bool same = other.high.xyz == mine.high.xyz && other.middle.xyz == mine.middle.xyz && other.low.xyz == mine.low.xyz;
  vec3 of_mine = vec3(mine.high.w, mine.middle.w, mine.low.w), of_other = vec3(other.high.w, other.middle.w, other.low.w);
  bvec3 less = lessThan(of_mine, of_other), more = greaterThan(of_mine, of_other);
  bool is_less = more.x ? false : less.x ? true : more.y ? false : less.y ? true : less.z;
  bool is_equal = of_mine == of_other;
  cell_failed = cell_failed || !same;  // too close for the parts from which the other planes are computed
  cell_is_empty = is_less || (is_equal && names[j] < names[own]);
  beyond = 3e38;
}

void test_ball(uint j) {
  ++spent;
  vec4 high = balls[j].high, middle = balls[j].middle;
  precise vec4 difference = (high - own_high) + (middle - own_middle);  // w: of the radii
  float square = dot(difference.xyz, difference.xyz), both = high.w + own_radius;
  if (square > both * both * 1.000001) return;
  if (square < 1e-24) {
    test_concentric(j);
    return;
  }
  float closeness = inversesqrt(square), size = square * closeness;
  float radii = difference.w * both * closeness;
  float offset = 0.5 * (size - radii) * own_unit;
  // (|d| + (r_i - r_j)(r_i + r_j) / |d|) / 2 r_i: each term within 20 roundings, the normal within 8.
  float terms = 0.5 * (size + abs(radii)) * own_unit;
  float error = kRounding * (8.0 + 20.0 * terms) + kSplitRounding * closeness * (1.0 + both * own_unit);
  clip_cell(vec4(difference.xyz * closeness, offset), error);
}

// A power of corner c to the cell's ball above which no ball of the node takes the corner, less the node's `least`.
float power_over(uint k, vec3 offset, uint c) {
  vec3 v = corner[c].xyz;
  vec3 x = v * own_radius + offset;
  vec4 axis_0 = nodes[k].axis_0, axis_1 = nodes[k].axis_1, axis_2 = nodes[k].axis_2;
  vec3 along = vec3(dot(axis_0.xyz, x), dot(axis_1.xyz, x), dot(axis_2.xyz, x));
  vec3 across = abs(nodes[k].slope.xyz - 2.0 * along);
  return dot(x, x) - own_radius * own_radius * (dot(v, v) - 1.0) - dot(across, vec3(axis_0.w, axis_1.w, axis_2.w));
}

// The host's CellBuilder::may_cut(), with a margin for float: every term is at most scale^2, and fewer than 128 terms
// are rounded.
bool may_cut(uint k) {
  vec4 high = nodes[k].middle_high, low = nodes[k].middle_low;
  if (high.w < 0.0) return false;
  precise vec3 offset = (own_high.xyz - high.xyz) + (own_middle.xyz - low.xyz);
  float distance = length(offset);
  if (distance > (high.w + own_radius) * 1.00001) return false;
  float scale = distance + 2.0 * own_radius + high.w;
  float least = 3e38;
  uint last = corner_count - 1u;
  for (uint c = 0u; c <= last; c += 4u) {
    float p0 = power_over(k, offset, c), p1 = power_over(k, offset, min(c + 1u, last));
    float p2 = power_over(k, offset, min(c + 2u, last)), p3 = power_over(k, offset, min(c + 3u, last));
    least = min(least, min(min(p0, p1), min(p2, p3)));
    ++spent;
  }
  return least <= 128.0 * kRounding * scale * scale - low.w;
}

void test_hints() {
  for (uint k = 1u; k <= kBallHints && !walk_is_over(); ++k) {
    if (own + k < push.ball_count) test_ball(own + k);
    if (own >= k && !walk_is_over()) test_ball(own - k);
  }
}

void test_leaf(uint k) {
  uint first = (k - push.first_leaf) * kBallsPerLeaf;
  uint end = min(first + kBallsPerLeaf, push.ball_count);
  for (uint j = first; j < end && !walk_is_over(); ++j) {
    bool tested = j + kBallHints >= own && j <= own + kBallHints;  // a hint, or the ball itself
    if (!tested) test_ball(j);
  }
}

// The walk goes from the ball's own leaf upwards, so that near balls come first. The tree is complete and needs no
// stack: counted from 1, the children of m are 2 m and 2 m + 1, its sibling is m ^ 1, and the node after the subtree of
// m is m + 1 without its trailing zeros.
void walk_balls() {
  uint up = own / kBallsPerLeaf + push.first_leaf + 1u;  // its leaf, whose balls are hints; then its subtree
  uint root = up ^ 1u, m = root;
  while (up > 1u && !walk_is_over()) {
    ++spent;
    bool enter = may_cut(m - 1u), leaf = m > push.first_leaf;
    if (enter && leaf) test_leaf(m - 1u);
    if (enter && !leaf) {
      m = 2u * m;
    } else {
      uint next = (m + 1u) >> findLSB(m + 1u);
      int deeper = findMSB(next) - findMSB(root);
      bool inside = deeper >= 0 && next >> deeper == root;
      up = inside ? up : up >> 1;
      m = inside ? next : up ^ 1u;
      root = inside ? root : m;
    }
  }
}

#endif
