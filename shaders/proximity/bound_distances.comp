#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Bounds of the distance between two bodies in a pose, or only the verdict free, hit or undecided: one invocation for
// each pose. The covers come first, then the balls inside, in one loop, so that no invocation waits for its neighbours
// between the two. docs/theory.md, "Many poses on a device".
#include "proximity_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const bool kVerdicts = false;
layout(push_constant) uniform Push { ProximityConstants push; };
layout(set = 0, binding = 0) readonly buffer Nodes { ProximityNode nodes[]; };
layout(set = 0, binding = 1) readonly buffer Bodies { ProximityBody bodies[]; };
layout(set = 0, binding = 2) readonly buffer Poses { ProximityPose poses[]; };
layout(set = 0, binding = 3) writeonly buffer Verdicts { uint verdicts[]; };
layout(set = 0, binding = 3) writeonly buffer Bounds { ProximityBounds bounds[]; };

const float kFarther = 9.1e18;  // than any two balls in range
const float kSquare = 3.0e38;   // more than any square of lengths in range
const float kLargest = 1.8e19;  // its square is a float
const uint kNone = 0xffffffffu;
const float kUnit = 1.1920929e-7;  // 2^-23: a result of a sum or product may be rounded either way

// The pose, and the errors of separations.
uint body_a, body_b;
vec4 row_x, row_y, row_z;
float inside_error, cover_error;

// The search. Its stack has pairs of nodes with pairs of balls that are still to be followed, bit 8 j + k for ball k of
// a and ball j of b; the nodes of a with their level in the upper bits. Levels increase along the stack, and two nodes of
// the lowest level are never there, so that it has room.
ProximityTree tree_a, tree_b;
float reach;      // pairs of balls with a computed separation of this or more are passed over
float is_enough;  // the search ends at balls that are as close
uvec2 closest_balls;
uint node_a, node_b, level;
vec4 around_a;  // holds the balls of node_a
bool has_nodes, is_dive;
uint steps;
uint depth;
uint stack_a[kProximityLevels], stack_b[kProximityLevels];
uvec2 stack_pairs[kProximityLevels];

vec3 in_frame_of_a(vec3 p) {
  return vec3(row_x.x * p.x + row_x.y * p.y + row_x.z * p.z + row_x.w,
              row_y.x * p.x + row_y.y * p.y + row_y.z * p.z + row_y.w,
              row_z.x * p.x + row_z.y * p.y + row_z.z * p.z + row_z.w);
}

float square_of(vec3 d) { return d.x * d.x + d.y * d.y + d.z * d.z; }

// Of a number that may be flushed to 0, where an inverse square root is not a number.
float root_of(float square) { return square > 1e-37 ? sqrt(square) : 0.0; }

bool is_closer(float square, float both) { return both > 0.0 && square < both * both; }

bool is_finite(vec4 v) {
  return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec4(0x7f800000u)));
}

// From a pose between the frames of the bodies to one between those of the trees, and its errors. False: out of range,
// or no rotation.
bool centre_pose(ProximityBody a, ProximityBody b) {
  if (!is_finite(row_x) || !is_finite(row_y) || !is_finite(row_z)) return false;
  vec3 from = b.centre.xyz, to = a.centre.xyz;
  float size_b = abs(from.x) + abs(from.y) + abs(from.z);
  float lengths = abs(row_x.w) + abs(row_y.w) + abs(row_z.w) + size_b + abs(to.x) + abs(to.y) + abs(to.z);
  if (!(lengths < 3e18)) return false;
  vec3 x = row_x.xyz, y = row_y.xyz, z = row_z.xyz;
  if (!(max(max(square_of(x), square_of(y)), square_of(z)) < 1.5)) return false;
  vec3 squares = vec3(square_of(x), square_of(y), square_of(z)) - 1.0;
  vec3 products = vec3(x.x * y.x + x.y * y.y + x.z * y.z, y.x * z.x + y.y * z.y + y.z * z.z,
                       z.x * x.x + z.y * x.y + z.z * x.z);
  if (!(dot(cross(x, y), z) > 0.0)) return false;  // a reflection
  float skew = 1.01 * root_of(square_of(squares) + 2.0 * square_of(products)) + 16.0 * kUnit;
  if (!(skew < 1e-3)) return false;
  vec3 centre = in_frame_of_a(from) - to;
  row_x.w = centre.x;
  row_y.w = centre.y;
  row_z.w = centre.z;
  float apart = root_of(square_of(centre));
  float inside_size = a.inside.reach + b.inside.reach + apart, cover_size = a.cover.reach + b.cover.reach + apart;
  if (!(max(inside_size, cover_size) < 8.9e18)) return false;
  float common_error = 14.0 * kUnit * lengths + 8.6736174e-19;  // 2^-60
  inside_error = 22.1 * kUnit * inside_size + common_error + 1.02 * skew * (size_b + b.inside.reach);
  cover_error = 22.1 * kUnit * cover_size + common_error + 1.02 * skew * (size_b + b.cover.reach);
  return true;
}

// False: nothing is known about the pose.
bool place(ProximityPose pose) {
  row_x = pose.row_x;
  row_y = pose.row_y;
  row_z = pose.row_z;
  inside_error = pose.inside_error;
  cover_error = pose.cover_error;
  body_a = pose.a & ~kProximityCentred;
  body_b = pose.b;
  if (max(body_a, body_b) >= push.body_count) return false;
  return (pose.a & kProximityCentred) != 0u || centre_pose(bodies[body_a], bodies[body_b]);
}

void go_to(uint a, uint b, uint to_level, vec4 around) {
  node_a = a;
  node_b = b;
  level = to_level;
  around_a = around;
  has_nodes = true;
}

void go_to_roots() {
  depth = 0u;
  go_to(tree_a.root, tree_b.root, 0u, vec4(0.0, 0.0, 0.0, 9e18));
}

// Balls inside prove a hit where they overlap by more than the error; covers that they are apart, where none are closer
// than the error.
void begin_search(bool is_inside) {
  tree_a = bodies[body_a].cover;
  tree_b = bodies[body_b].cover;
  if (is_inside) {
    tree_a = bodies[body_a].inside;
    tree_b = bodies[body_b].inside;
  }
  float error = is_inside ? -inside_error : cover_error;
  reach = kVerdicts ? error : kFarther;
  is_enough = error;
  closest_balls = uvec2(kNone);
  steps = 0u;
  is_dive = !kVerdicts;
  go_to_roots();
}

// The bits of row j of pairs of balls.
uvec2 row_bits(uint row, uint j) {
  uint shifted = row << (8u * (j & 3u));
  return j < 4u ? uvec2(shifted, 0u) : uvec2(0u, shifted);
}

// All pairs of balls of the two nodes that are closer than the reach. `closest` is the number 8 j + k of the closest,
// or for verdicts of those that overlap most. On the lowest level the closest shortens the reach.
uvec2 compare(bool is_lowest, out uint closest) {
  vec4 of_a[kProximityWidth];
  [[unroll]] for (uint k = 0u; k < kProximityWidth; ++k) of_a[k] = nodes[node_a].balls[k];
  uvec2 pairs = uvec2(0u);
  float least = kVerdicts ? kSquare : kFarther;
  closest = 0u;
  [[dont_unroll]] for (uint j = 0u; j < kProximityWidth; ++j) {
    vec4 ball = nodes[node_b].balls[j];
    if (ball.w < 0.0) break;
    vec3 centre = in_frame_of_a(ball.xyz);
    float more = ball.w + reach;
    if (!is_closer(square_of(around_a.xyz - centre), min(around_a.w + more, kLargest))) continue;
    uint row = 0u;
    [[unroll]] for (uint k = 0u; k < kProximityWidth; ++k) {
      float square = square_of(of_a[k].xyz - centre), both = of_a[k].w + more;
      bool closer = is_closer(square, both);
      float apart = kVerdicts ? square - both * both : root_of(square) - (of_a[k].w + ball.w);
      bool is_least = closer && apart < least;
      row |= closer ? 1u << k : 0u;
      least = is_least ? apart : least;
      closest = is_least ? 8u * j + k : closest;
    }
    pairs |= row_bits(row, j);
    if (is_lowest && !kVerdicts) reach = min(reach, least);
  }
  return pairs;
}

// A node of the lowest level is not replaced, so each node of the other tree is followed once.
uvec2 without_repeats(uvec2 pairs, bool a_is_lowest) {
  uvec2 kept = uvec2(0u);
  uint seen = 0u;
  [[unroll]] for (uint j = 0u; j < kProximityWidth; ++j) {
    uint row = ((j < 4u ? pairs.x : pairs.y) >> (8u * (j & 3u))) & 255u;
    row = a_is_lowest ? row & (~row + 1u) : row & ~seen;
    seen |= row;
    kept |= row_bits(row, j);
  }
  return kept;
}

uint first_of(uvec2 pairs) { return pairs.x != 0u ? uint(findLSB(pairs.x)) : 32u + uint(findLSB(pairs.y)); }

uvec2 without(uvec2 pairs, uint pair) {
  return pairs & ~(pair < 32u ? uvec2(1u << pair, 0u) : uvec2(0u, 1u << (pair - 32u)));
}

bool is_lowest_in(ProximityTree tree) { return level + 1u >= tree.levels; }

// To the nodes below this pair of balls of the present nodes.
void descend(uint pair) {
  uint k = pair & 7u, j = pair >> 3u;
  bool a_is_lowest = is_lowest_in(tree_a), b_is_lowest = is_lowest_in(tree_b);
  vec4 around = around_a;
  uint a = node_a, b = node_b;
  if (!a_is_lowest) {
    around = nodes[node_a].balls[k];
    a = nodes[node_a].below[k];
  }
  if (!b_is_lowest) b = nodes[node_b].below[j];
  go_to(a, b, level + 1u, around);
}

// The last pair of the stack. There may be nothing to follow there: the reach may be shorter than when it was found.
void go_back() {
  uint top = depth - 1u;
  uvec2 pairs = stack_pairs[top];
  uint pair = first_of(pairs);
  pairs = without(pairs, pair);
  stack_pairs[top] = pairs;
  if ((pairs.x | pairs.y) == 0u) depth = top;
  node_a = stack_a[top] & ((1u << kProximityNodeBits) - 1u);
  level = stack_a[top] >> kProximityNodeBits;
  node_b = stack_b[top];
  around_a = vec4(0.0, 0.0, 0.0, 9e18);  // of a node of the lowest level, which is not replaced
  if (!kVerdicts && is_lowest_in(tree_a) == is_lowest_in(tree_b)) {
    vec4 of_a = nodes[node_a].balls[pair & 7u], of_b = nodes[node_b].balls[pair >> 3u];
    if (!is_closer(square_of(of_a.xyz - in_frame_of_a(of_b.xyz)), of_a.w + reach + of_b.w)) return;
  }
  descend(pair);
}

// A comparison of two nodes of the lowest level. False: the search ends.
bool take_balls(uvec2 pairs, uint closest) {
  if ((pairs.x | pairs.y) != 0u) {
    closest_balls = uvec2(nodes[node_a].below[closest & 7u], nodes[node_b].below[closest >> 3u]);
    if (kVerdicts || reach <= is_enough) return false;
  }
  if (is_dive) {
    is_dive = false;
    go_to_roots();
  }
  return true;
}

// One step. False: the search has ended.
bool search_on() {
  if (!has_nodes) {
    if (depth == 0u) return false;
    go_back();
    if (!has_nodes) return true;
  }
  has_nodes = false;
  bool a_is_lowest = is_lowest_in(tree_a), b_is_lowest = is_lowest_in(tree_b);
  uint closest;
  uvec2 pairs = compare(a_is_lowest && b_is_lowest, closest);
  if (a_is_lowest && b_is_lowest) return take_balls(pairs, closest);
  if ((pairs.x | pairs.y) == 0u) return true;
  if (a_is_lowest != b_is_lowest && !is_dive) {
    pairs = without_repeats(pairs, a_is_lowest);
    closest = first_of(pairs);
  }
  pairs = is_dive ? uvec2(0u) : without(pairs, closest);
  if ((pairs.x | pairs.y) != 0u) {
    stack_a[depth] = node_a | level << kProximityNodeBits;
    stack_b[depth] = node_b;
    stack_pairs[depth] = pairs;
    ++depth;
  }
  descend(closest);
  return true;
}

bool has_found() { return closest_balls.x != kNone; }

void main() {
  uint pose = workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (pose >= push.pose_count) return;
  ProximityBounds found = ProximityBounds(0.0, -1.0, kNone, kNone, kNone, kNone);
  uint verdict = kProximityUndecided;
  bool is_inside = false, covers_are_done = false, inside_is_done = false, goes_on = place(poses[pose]);
  if (goes_on) begin_search(is_inside);
  [[dont_unroll]] while (goes_on) {
    bool is_empty = min(tree_a.levels, tree_b.levels) == 0u;
    if (!is_empty && ++steps <= push.most_steps && search_on()) continue;
    bool is_searched = !is_empty && steps <= push.most_steps;
    if (is_inside) {
      inside_is_done = is_empty || is_searched;
      if (has_found()) {
        verdict = kProximityHit;
        found.inside_a = closest_balls.x;
        found.inside_b = closest_balls.y;
        found.upper = max(0.0, (reach + inside_error) * 1.0000005);
      }
    } else {
      covers_are_done = is_empty || is_searched;
      if (is_searched && has_found()) {
        found.cover_a = closest_balls.x;
        found.cover_b = closest_balls.y;
        found.lower = max(0.0, (reach - cover_error) * 0.9999995);
      } else if (is_searched) {
        verdict = kProximityFree;
      }
    }
    goes_on = !is_inside && (!kVerdicts || verdict == kProximityUndecided);
    is_inside = true;
    if (goes_on) begin_search(is_inside);
  }
  if (!(covers_are_done && inside_is_done) && push.leaves_rest != 0u) {
    if (verdict == kProximityUndecided) verdict = kProximityGivenUp;
    found.lower = -1.0;
  }
  if (found.upper < 0.0) found.upper = uintBitsToFloat(0x7f800000u);  // infinity
  if (kVerdicts) verdicts[pose] = verdict;
  else bounds[pose] = found;
}
