// The generalised winding number (Jacobson et al. 2013) of a point, by one invocation: far parts of the mesh by their
// moments (Barill et al. 2018), near triangles exactly. Include tree.glsl before.
//
// w(p) is the integral over the mesh of n . K(x) / 4 pi with K(x) = (x - p) / |x - p|^3. A part with area A, area
// centroid c at distance d from p, no point further than r < d from c, is replaced by the first two terms of Taylor's
// series around c. K is minus the gradient of 1/|x - p|, a harmonic function whose third derivative, as a symmetric
// form, is at most 3! / |x - p|^4 (Banach: such forms are largest on the diagonal, there it is 6 |P3| / |x - p|^4). The
// remainder is thus at most 1/2 * 6 / (4 pi (d - r)^4) times the integral of |x - c|^2: texel 1's w over (d - r)^4. The
// bounds of all parts that are used add up to less than the tolerance (docs/theory.md, "Winding numbers by the tree").
#ifndef MEDIAL_VK_WINDING_GLSL
#define MEDIAL_VK_WINDING_GLSL

struct Winding {
  float number;
  float bound;    // of the error of the expansions; rounding adds about 1e-5
  bool complete;  // false: the walk was too long, sum all triangles
};

const float kFourPi = 12.566370614;

// Solid angle of a triangle seen from p over 4 pi, positive from behind (van Oosterom and Strackee 1983).
float winding_of_triangle(vec3 p, TriangleTexels t) {
  vec3 a = t.a.xyz - p;
  vec3 b = a + t.ab.xyz, c = a + t.ac.xyz;
  float la = length(a), lb = length(b), lc = length(c);
  float volume = dot(a, cross(t.ab.xyz, t.ac.xyz));  // a . (b x c) without its cancellation
  float spread = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  // On the triangle's plane outside the triangle the angle is 0; atan(0, 0) would be undefined at a corner.
  return volume == 0.0 ? 0.0 : 2.0 * atan(volume, spread) / kFourPi;
}

// An invocation may make three walks (decide_line_side.comp): each takes at most a third of its loop budget.
const uint kWindingRounds = kRounds / 3u;

struct Expansion {
  float value;
  float bound;
  float angle;  // at least the solid angle of the part over 4 pi
};

// A part may use this much of the tolerance that is left, by its solid angle (measured), and at most kMostOfRest of it, so
// that some is always left.
const float kRestPerAngle = 0.5, kMostOfRest = 0.25;

Expansion expand_child(vec3 p, uint texel) {
  vec4 centre = tree_texel(texel), normal = tree_texel(texel + 1u);
  vec4 diagonal = tree_texel(texel + 2u), mixed = tree_texel(texel + 3u);
  vec3 r = centre.xyz - p;
  float d = length(r);
  vec3 u = r / max(d, 1e-20);
  float gap = max(d - centre.w, 0.0) * (1.0 - 1e-6);
  float bound = gap > 1e-9 ? normal.w / (gap * gap * gap * gap) : 1e30, angle = diagonal.w / max(gap * gap, 1e-18);
  float second = dot(diagonal.xyz, u * u) + dot(mixed.xyz, vec3(u.x * u.y, u.x * u.z, u.y * u.z));
  float square = 1.0 / max(d * d, 1e-30);
  return Expansion(square * (dot(u, normal.xyz) + second / max(d, 1e-15)), bound, angle);
}

// Adds the expansion of a child if its bound fits `rest`, the tolerance that is left, and returns kSkipped; otherwise
// the child's position.
uint use_or_open(vec3 p, uint moments, uint node, uint side, bool inner, inout float rest, inout Winding winding) {
  Expansion e = expand_child(p, moments + 8u * node + 4u * side);
  bool used = inner && e.bound <= rest * min(kRestPerAngle * e.angle, kMostOfRest);
  rest -= used ? e.bound : 0.0;
  winding.number += used ? e.value : 0.0;
  winding.bound += used ? e.bound : 0.0;
  vec4 lower = tree_texel(4u * node + 2u * side), upper = tree_texel(4u * node + 2u * side + 1u);
  return used ? kSkipped : tree_position(lower, upper);
}

Winding winding_number(vec3 p, float tolerance) {
  uint positions[kStackSize];
  uint size = 0u, position = 0u, rounds = 0u;
  uint moments = 4u * tree_node_count();
  Winding winding = Winding(0.0, 0.0, false);
  float rest = tolerance;
  while (position != kFinished) {
    uint descents = 0u;
    while (descents < kDescents) {
      bool inner = position < kLeaf;
      uint node = inner ? position : 0u;
      uint next_0 = use_or_open(p, moments, node, 0u, inner, rest, winding);
      uint next_1 = use_or_open(p, moments, node, 1u, inner, rest, winding);
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
      float part = winding_of_triangle(p, load_triangle(first + i));
      winding.number += i < count ? part : 0.0;
      if (++i >= count) break;
    }
    tested_triangles += count;
    bool pop = !down && size > 0u;
    size -= uint(pop);
    position = down ? position : (pop ? positions[min(size, kStackSize - 1u)] : kFinished);
    if (position == kFinished || ++rounds == kWindingRounds) break;
  }
  winding.complete = position == kFinished;
  return winding;
}

#endif
