// Decides whether two carriers may hold two spokes of one salient point (docs/theory.md, Lemmas C to J).
#ifndef MEDIAL_VK_CARRIER_PAIRS_GLSL
#define MEDIAL_VK_CARRIER_PAIRS_GLSL
#include "certified/carriers.glsl"
#include "certified/common_corner.glsl"

const float kLeastCosPhi = 0.25;  // sharper edges are not tested for chords: docs/theory.md, "Rounding"

// Lemmas C and D: true if their spokes can be 2 theta apart.
bool can_turn(Carrier a, Carrier b, float theta) {
  float left = 2.0 * (theta - kAngleSlack) - a.spokes.w - b.spokes.w;
  return left <= 0.0 || dot(a.spokes.xyz, b.spokes.xyz) <= cosine(left) + kCosineSlack;
}

// The two normals between which the spokes to a face or an edge lie.
void normals_of(uint name, out vec3 first, out vec3 second) {
  uint t = name / 8u, kind = name % 8u;
  first = triangle_texel(4u * t + 3u).xyz;
  second = first;
  if (kind == kFace) return;
  if (kind < kFirstCorner) second = triangle_texel(4u * neighbour_of(t, kind - kFirstEdge) + 3u).xyz;
}

// True if the carrier is listed by an untrusted triangle, with spokes from both sides.
bool is_two_sided(uint name) {
  return kHasUntrusted && (corners_and_flags(name / 8u).w & kLinkBothSides) != 0u;
}

// The same test without a cap, for faces and edges: distances on the sphere are convex below a right angle, so two
// spokes on two arcs differ by no more than some two ends of the arcs, if these are closer than a right angle.
bool can_turn_between_normals(uint first, uint second, float theta) {
  if (first % 8u >= kFirstCorner || second % 8u >= kFirstCorner) return true;
  if (is_two_sided(first) || is_two_sided(second)) return true;
  vec3 a, b, c, d;
  normals_of(first, a, b);
  normals_of(second, c, d);
  float least = min(min(dot(a, c), dot(a, d)), min(dot(b, c), dot(b, d)));
  return least <= max(0.0, cosine(2.0 * (theta - kAngleSlack))) + kCosineSlack;
}

// Projects x together with the centre.
vec3 project(vec4 span, vec3 x) {
  float along = dot(span.xyz, x);
  return span.w == kPlane ? x - along * span.xyz : span.w == kLine ? along * span.xyz : vec3(0.0);
}

// The projection of the centre of the box onto the span of a carrier, and that span (carriers.glsl).
struct Placed {
  vec4 foot, span;
};

Placed placed(uint name, Box box) {
  Feature f = feature_named(name, box);
  return Placed(f.foot, f.span);
}

// Lemma H: true if the feet can be as far apart as the object angle requires, 2 D sin(theta), anywhere in the box. D is
// bounded by the mixture of the two distances whose gradient best cancels that of the distance of the feet.
bool can_be_wide(Carrier first, Carrier second, float sine, Box box) {
  Placed at_a, at_b;
  for (uint k = 0u; k < 2u;) {  // here and below: a loop, so that drivers translate the code of a carrier once
    at_a = at_b;
    at_b = placed(k == 0u ? first.name : second.name, box);
    if (++k == 2u) break;
  }
  vec4 span_a = at_a.span, span_b = at_b.span;
  if (span_a.w == kUnknownSpan || span_b.w == kUnknownSpan) return true;
  vec4 a = first.nearest, b = second.nearest, ab = b - a;
  vec3 apart = at_a.foot.xyz - at_b.foot.xyz;
  vec3 gradient = unit_or_zero(apart);
  gradient = project(span_a, gradient) - project(span_b, gradient) + 2.0 * sine * a.xyz;
  float share = clamp(-dot(gradient, ab.xyz) / max(2.0 * sine * dot(ab.xyz, ab.xyz), 1e-6), -2.0, 3.0);
  // Outside [0, 1] one distance has a negative weight: the upper bound of Lemma F applies to it.
  float excess = max(max(-share, share - 1.0), 0.0);
  float bend = excess * 0.5 * box.circumradius * box.circumradius / max(share < 0.0 ? b.w : a.w, 1e-30);
  float slack = 4.0 * (at_a.foot.w + at_b.foot.w) +
                (1.0 + 2.0 * excess) * near_distance_slack(min(a.w, b.w), box.circumradius);
  vec4 mixture = a + share * ab;
  bool wide = false;
  for (uint k = 0; k < 8u; ++k) {
    vec3 x = box.half_sides * corner_sign(k);
    vec3 chord = apart + project(span_a, x) - project(span_b, x);
    wide = wide || length(chord) + slack >= 2.0 * sine * (mixture.w - dot(mixture.xyz, x) - bend - slack);
  }
  return wide;
}

// True if the corners of a carrier, of this kind and of a triangle with these corners, are corners of another triangle.
bool holds(uvec3 other, uint kind, uvec3 corners) {
  bool is_edge = kind >= kFirstEdge && kind < kFirstCorner, is_corner = kind >= kFirstCorner && kind < kFront;
  uint k = is_edge ? kind - kFirstEdge : is_corner ? kind - kFirstCorner : 0u;
  bool held = any(equal(other, uvec3(corners[k])));
  if (!is_corner) held = held && any(equal(other, uvec3(corners[k == 2u ? 0u : k + 1u])));
  if (!is_corner && !is_edge) held = held && any(equal(other, uvec3(corners.z)));
  return held;
}

// Corners of a carrier: an edge repeats one of them, a vertex two.
void corners_of(uint name, out vec3 p[3]) {
  TriangleTexels t = load_triangle(name / 8u);
  uint kind = name % 8u;
  vec3 a = t.a.xyz, b = corner_of(t, 1u), c = corner_of(t, 2u);
  bool is_edge = kind >= kFirstEdge && kind < kFirstCorner, is_corner = kind >= kFirstCorner && kind < kFront;
  uint first = is_edge ? kind - kFirstEdge : is_corner ? kind - kFirstCorner : 0u;
  p[0] = first == 0u ? a : first == 1u ? b : c;
  p[1] = is_corner ? p[0] : first == 0u ? b : first == 1u ? c : a;
  p[2] = is_edge ? p[1] : is_corner ? p[0] : c;
}

// True if a point of one carrier and a point of the other lie in one triangle, which has one nearest point.
bool share_triangle(uint first, uint second) {
  if (!is_two_sided(first) && !is_two_sided(second)) return false;
  uvec4 a = corners_and_flags(first / 8u), b = corners_and_flags(second / 8u);
  return holds(a.xyz, second % 8u, b.xyz) || holds(b.xyz, first % 8u, a.xyz);
}

// Lemma E at one end, if it is tested there: the normals, and the value that -n.c must reach for one of them; or the
// arc of spokes to an edge (Lemma I), with its middle in `normal`.
struct Facing {
  vec3 normal, other;
  float least;
  bool is_tested;
  bool is_arc;
  vec3 along;     // unit, of the edge
  vec2 half_arc;  // cosine and sine of half the arc
  float tilt;     // of the edge
};

Facing facing_of(uint name, float least_sine) {
  Facing f = Facing(vec3(0.0), vec3(0.0), least_sine - 2.0 * kCosineSlack, false, false, vec3(0.0), vec2(0.0), 0.0);
  uint t = name / 8u, kind = name % 8u;
  if (is_two_sided(name)) {
    f.is_tested = kind < kFirstCorner || kind == kFront;
    f.is_arc = kind >= kFirstEdge && kind < kFirstCorner;
    TriangleTexels texels = load_triangle(t);
    f.normal = kind == kFront ? -texels.normal.xyz : texels.normal.xyz;
    f.other = f.normal;
    if (!f.is_arc) return f;
    uint k = kind - kFirstEdge;
    vec4 arc = corner_cap(neighbour_of(t, k));
    vec3 e = corner_of(texels, k == 2u ? 0u : k + 1u) - corner_of(texels, k);
    float size = max(length(e), 1e-30);
    f.normal = arc.xyz;
    float half_angle = min(arc.w, 1.5707963);
    f.half_arc = vec2(cosine(half_angle), sine(half_angle));
    f.along = e / size;
    f.tilt = 1.2e-7 / size;
    return f;
  }
  if (kind >= kFirstCorner) return f;  // vertices, and whole triangles
  normals_of(name, f.normal, f.other);
  float cos_phi = sqrt(max(0.0, 0.5 + 0.5 * dot(f.normal, f.other)));  // of the cap around both normals
  f.least = (least_sine - kCosineSlack) * cos_phi - kCosineSlack;
  f.is_tested = cos_phi >= kLeastCosPhi;
  return f;
}

// The greatest -s.d of their spokes s.
float depth_along(Facing f, vec3 d) {
  float depth = max(-dot(f.normal, d), -dot(f.other, d));
  if (kHasUntrusted && f.is_arc) {
    vec3 across = d - dot(d, f.along) * f.along;
    float size = length(across), x = -dot(f.normal, across), y = sqrt(max(0.0, size * size - x * x));
    depth = x >= size * f.half_arc.x ? size : x * f.half_arc.x + y * f.half_arc.y;
    depth += (f.tilt + 2.0 * kCosineSlack) * length(d);
  }
  return depth;
}

// Moves the next corner to the front. Loops over corners rotate the array, since a varying index is slow and code for
// every pair of corners takes long to translate.
void rotate(inout vec3 p[3]) {
  vec3 first = p[0];
  p[0] = p[1];
  p[1] = p[2];
  p[2] = first;
}

// Lemma E: true if both may face each other along some chord.
bool can_face(uint first, uint second, float sine) {
  Facing a, b;
  vec3 p[3], q[3], mean = vec3(0.0);
  for (uint k = 0u; k < 2u;) {
    a = b;
    p = q;
    b = facing_of(k == 0u ? first : second, sine);
    corners_of(k == 0u ? first : second, q);
    if (++k == 2u) break;
  }
  if (!a.is_tested && !b.is_tested) return true;
  for (uint i = 0; i < 3u;) {
    [[unroll]] for (uint k = 0; k < 3u; ++k) mean += unit_or_zero(q[k] - p[0]);
    rotate(p);
    if (++i == 3u) break;
  }
  mean = unit_or_zero(mean);
  float most_a = -1.0, most_b = -1.0;
  bool behind_a = false, behind_b = false, bounded = true;
  for (uint k = 0; k < 9u;) {
    vec3 chord = q[0] - p[0];
    bool apart = dot(chord, chord) > 0.0;  // else a corner of both
    float along = dot(chord, mean) - near_slack;
    float depth_a = depth_along(a, chord) + near_slack, depth_b = depth_along(b, -chord) + near_slack;
    bounded = bounded && (!apart || along > 0.0);
    behind_a = behind_a || (apart && depth_a > 2.0 * near_slack);
    behind_b = behind_b || (apart && depth_b > 2.0 * near_slack);
    float inverse = apart ? 1.0 / max(along, 1e-30) : 0.0;
    most_a = max(most_a, depth_a * inverse);
    most_b = max(most_b, depth_b * inverse);
    rotate(q);
    if (++k % 3u == 0u) rotate(p);
    if (k == 9u) break;
  }
  bool a_faces = !a.is_tested || (behind_a && (!bounded || most_a >= a.least));
  bool b_faces = !b.is_tested || (behind_b && (!bounded || most_b >= b.least));
  return a_faces && b_faces;
}

// Lemma F: a third carrier is nearer wherever the two are equally near. Row 0 of carrier_order holds the carriers that
// are tried.
bool is_beaten(Carrier a, Carrier b, Carrier nearest_row, Box box) {
  vec3 ab = b.nearest.xyz - a.nearest.xyz;
  float inverse = 1.0 / max(dot(ab, ab), 1e-30), slack = max(error_of(a, box).x, error_of(b, box).x);
  bool beaten = false;
  for (uint k = 0; k < kPairRivals;) {
    Carrier rival = CARRIER_OF_LANE(nearest_row, carrier_order, kept_count, 0u, k);
    float share = clamp(dot(ab, rival.nearest.xyz - a.nearest.xyz) * inverse, 0.0, 1.0);
    bool is_third = rival.name != a.name && rival.name != b.name;
    beaten = is_third && beats(rival, mix(a.nearest, b.nearest, share), slack, box);
    if (beaten || ++k >= min(kPairRivals, kept_count)) break;
  }
  return beaten;
}

// True if a pair that turns enough, and that no third carrier beats, may hold the spokes.
bool is_feasible_survivor(Carrier a, Carrier b, float theta, float sine, Box box) {
  return can_turn_between_normals(a.name, b.name, theta) && !share_triangle(a.name, b.name) &&
         can_be_wide(a, b, sine, box) && can_face(a.name, b.name, sine) &&
         (!kHasUntrusted || can_meet_at_corner(a.name, b.name, sine));
}

#endif
