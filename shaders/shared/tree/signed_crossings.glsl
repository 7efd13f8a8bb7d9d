// The winding number of a closed surface, from the triangles that a ray from the point crosses: 1 for each that it
// leaves through the front, -1 for each that it enters (docs/theory.md, "Winding numbers by rays"). A sign that rounding
// may decide leaves the number unknown. Include tree.glsl before.
#ifndef MEDIAL_VK_SIGNED_CROSSINGS_GLSL
#define MEDIAL_VK_SIGNED_CROSSINGS_GLSL

struct Crossings {
  int sum;
  bool known;
};

// Errors of the determinants over the lengths that enter them, and of a distance along the ray (docs/theory.md,
// "Rounding").
const float kEdgeError = 2.2e-6, kVolumeError = 1e-6, kAlongError = 1e-6;

// Walks of winding numbers share the loop budget of an invocation (kWindingRounds).
const uint kCrossingRounds = kRounds / 3u;

// Off the axes, and mostly along the axis along which the box ends soonest.
vec3 direction_out(vec3 p) {
  vec3 lower = min(tree_texel(0u).xyz, tree_texel(2u).xyz), upper = max(tree_texel(1u).xyz, tree_texel(3u).xyz);
  vec3 to_lower = p - lower, to_upper = upper - p, nearest = min(to_lower, to_upper);
  vec3 sign_out = mix(vec3(1.0), vec3(-1.0), lessThan(to_lower, to_upper));
  bool along_x = nearest.x <= nearest.y && nearest.x <= nearest.z, along_y = nearest.y <= nearest.z;
  return along_x ? vec3(sign_out.x, 0.1373, 0.2917) : along_y ? vec3(0.2917, sign_out.y, 0.1373)
                                                              : vec3(0.1373, 0.2917, sign_out.z);
}

// Adds, so many times, the triangle with the corner a, as seen from the start of the ray, and edges ab and ac. The
// direction is a sum of a, b and c; if the signs of their weights agree, the line through the ray crosses the triangle.
// The crossing is ahead if all corners are, or if the start lies on the side of the plane from which the direction leads
// to it.
void add_crossing(vec3 direction, vec3 a, vec3 ab, vec3 ac, int times, inout Crossings crossings) {
  vec3 b = a + ab, c = a + ac;
  vec3 weights = vec3(dot(direction, cross(b, c)), dot(direction, cross(c, a)), dot(direction, cross(a, b)));
  vec3 along = vec3(dot(direction, a), dot(direction, b), dot(direction, c));
  float least = min(weights.x, min(weights.y, weights.z)), most = max(weights.x, max(weights.y, weights.z));
  float edges = dot(abs(ab) + abs(ac), vec3(1.0)), all = dot(abs(a), vec3(1.0)) + edges;
  float volume = dot(a, cross(ab, ac)), volume_error = kVolumeError * all * edges;
  bool misses = least < -kEdgeError * all && most > kEdgeError * all;
  bool is_ahead = min(along.x, min(along.y, along.z)) > kAlongError;
  bool is_behind = max(along.x, max(along.y, along.z)) < -kAlongError;
  bool upwards = least > kEdgeError * all, downwards = most < -kEdgeError * all;
  bool ahead = is_ahead || (upwards ? volume > volume_error : volume < -volume_error);
  bool behind = is_behind || (upwards ? volume < -volume_error : volume > volume_error);
  bool passes = upwards || downwards;
  crossings.sum += passes && ahead ? (upwards ? times : -times) : 0;
  crossings.known = crossings.known && (times == 0 || misses || is_behind || (passes && (ahead || behind)));
}

// The position of a child of a node if the ray may meet its box, or kSkipped. Boxes have a margin (device_tree.cpp); the
// times at which the ray enters and leaves have relative errors of 4.2e-7 at most.
uint child_on_ray(vec3 p, vec3 inverse, uint child) {
  vec4 lower = tree_texel(child), upper = tree_texel(child + 1u);
  vec3 to_lower = (lower.xyz - p) * inverse, to_upper = (upper.xyz - p) * inverse;
  vec3 entries = min(to_lower, to_upper), exits = max(to_lower, to_upper);
  float enters = max(max(entries.x, entries.y), max(entries.z, 0.0)), leaves = min(exits.x, min(exits.y, exits.z));
  return leaves * (1.0 + 1e-6) >= enters ? tree_position(lower, upper) : kSkipped;
}

// Precondition: no component of `direction` is 0, and not all are equal, as the sibling of a single leaf is a point far
// away on the diagonal.
Crossings signed_crossings(vec3 p, vec3 direction) {
  uint positions[kStackSize];
  uint size = 0u, position = 0u, rounds = 0u;
  vec3 inverse = 1.0 / direction;
  Crossings crossings = Crossings(0, true);
  while (position != kFinished) {
    uint descents = 0u;
    while (descents < kDescents) {
      bool inner = position < kLeaf;
      uint node = 4u * (inner ? position : 0u);
      uint next_0 = child_on_ray(p, inverse, node), next_1 = child_on_ray(p, inverse, node + 2u);
      bool both = next_0 != kSkipped && next_1 != kSkipped;
      positions[min(size, kStackSize - 1u)] = next_1;
      size += uint(inner && both);
      uint next = both ? next_0 : min(next_0, next_1);  // kSkipped is the largest
      position = inner ? next : position;
      tested_nodes += inner ? 2u : 0u;
      if (position >= kLeaf || ++descents == kDescents) break;
    }
    bool leaf = is_leaf(position), down = position < kLeaf;
    uint first = leaf ? position & kFirstMask : 0u, count = leaf ? position >> 24 : 0u;
    uint i = 0u;
    while (i <= count) {
      TriangleTexels t = load_triangle(first + i);
      add_crossing(direction, t.a.xyz - p, t.ab.xyz, t.ac.xyz, int(i < count), crossings);
      if (++i >= count) break;
    }
    tested_triangles += count;
    bool pop = !down && size > 0u && crossings.known;
    size -= uint(pop);
    position = down ? position : (pop ? positions[min(size, kStackSize - 1u)] : kFinished);
    if (position == kFinished || ++rounds == kCrossingRounds) break;
  }
  crossings.known = crossings.known && position == kFinished;
  return crossings;
}

#endif
