// Decides whether two carriers, each a face or an edge, that leave the same vertex can both hold a foot of one salient
// point (docs/theory.md, Lemma J). The configuration is the same at every scale of a cell at the vertex, so only
// directions are tested. Each case reduces to unit vectors in a plane, and each condition holds on an arc of their
// circle. Include after "carriers.glsl".
#ifndef MEDIAL_VK_COMMON_CORNER_GLSL
#define MEDIAL_VK_COMMON_CORNER_GLSL

const uint kMostArcs = 6u;
const vec3 kWholeCircle = vec3(0.0, 0.0, -1.0), kNowhere = vec3(0.0, 0.0, 1.0);

// Conditions on the unit vectors x of a plane, as (v, r): v.x >= r.
struct Circle {
  vec3 first, second;  // orthonormal, in the plane
  vec3 arcs[kMostArcs];
};

Circle circle_across(vec3 axis) {
  vec3 size = abs(axis);
  vec3 least = size.x <= size.y && size.x <= size.z ? vec3(1.0, 0.0, 0.0)
               : size.y <= size.z                   ? vec3(0.0, 1.0, 0.0)
                                                    : vec3(0.0, 0.0, 1.0);
  vec3 first = normalize(cross(axis, least));
  vec3 none = kWholeCircle;
  return Circle(first, cross(axis, first), vec3[kMostArcs](none, none, none, none, none, none));
}

vec3 arc_where(Circle circle, vec3 v, float r) { return vec3(dot(v, circle.first), dot(v, circle.second), r); }

// True if all arcs have a common point. In that case either all are the whole circle, or an end of one of them is in
// all others. The error of an end is that of its cosine, 1e-6, over its sine, and no more than the root of twice that
// error.
bool have_common_point(vec3 arcs[kMostArcs]) {
  bool free = true, found = false;
  for (uint i = 0u; i < kMostArcs; ++i) {
    float size = length(arcs[i].xy), cosine = arcs[i].z / max(size, 1e-30);
    if (arcs[i].z > size) return false;
    bool has_ends = arcs[i].z > -size;
    free = free && !has_ends;
    vec2 middle = arcs[i].xy / max(size, 1e-30);
    float s = sqrt(max(0.0, 1.0 - cosine * cosine)), off = min(1e-6 / max(s, 1e-30), 1.5e-3);
    bool first = has_ends, second = has_ends;
    for (uint j = 0u; j < kMostArcs; ++j) {
      vec2 along = vec2(dot(arcs[j].xy, middle), dot(arcs[j].xy, vec2(-middle.y, middle.x)));
      float least = arcs[j].z - off * length(arcs[j].xy);
      first = first && (i == j || cosine * along.x + s * along.y >= least);
      second = second && (i == j || cosine * along.x - s * along.y >= least);
    }
    found = found || first || second;
  }
  return free || found;
}

// A carrier as seen from one of its corners.
struct Leaving {
  bool is_face;
  vec3 toward;    // face: unit normal towards points that touch it
  vec3 walls[2];  // face: in its plane, unit, across the sides that leave the corner, into the triangle
  vec3 along;     // edge: unit, from the corner
  vec4 arc;       // edge: the spokes' middle and half-angle
  float tilt;     // greatest turn of these by rounding
};

// `k`: the index of the corner in the carrier's triangle.
Leaving leaving(uint name, uint k) {
  uint t = name / 8u, kind = name % 8u;
  TriangleTexels texels = load_triangle(t);
  vec3 here = corner_of(texels, k), normal = texels.normal.xyz;
  vec3 to_next = corner_of(texels, (k + 1u) % 3u) - here, to_last = corner_of(texels, (k + 2u) % 3u) - here;
  Leaving l;
  l.is_face = kind == kFace || kind == kFront;
  l.toward = kind == kFront ? normal : -normal;
  l.walls[0] = unit_or_zero(cross(normal, to_next));
  l.walls[1] = unit_or_zero(cross(to_last, normal));
  uint edge = l.is_face ? 0u : kind - kFirstEdge;
  bool has_arc = (distrust_of(corners_and_flags(t).w) & kLinkBothSides) != 0u;
  l.along = unit_or_zero(edge == k ? to_next : to_last);
  l.arc = edge_arc(normal, l.is_face ? t : neighbour_of(t, edge), has_arc && !l.is_face);
  float least = sqrt(min(dot(to_next, to_next), dot(to_last, to_last)));
  l.tilt = 1.2e-7 / max(least, 1e-30) + tilt_of(texels);
  return l;
}

// Bound of the errors of unit vectors and of directions of spokes; the flat edges of a face are assigned to the face,
// with an error of kAngleSlack.
float direction_error(Leaving a, Leaving b) { return a.tilt + b.tilt + kAngleSlack + kCosineSlack; }

// Points at equal distance from both faces, in front of both and within the walls of both: they lie on the plane
// between the faces.
Circle where_faces_meet(Leaving a, Leaving b) {
  vec3 across = a.toward - b.toward;
  float error = direction_error(a, b), size = length(across);
  if (size < 4.0 * error) return circle_across(a.toward);  // nothing is known: the whole circle
  Circle c = circle_across(across / size);
  float slack = 2.0 * error * (1.0 + 1.0 / size);
  c.arcs[0] = arc_where(c, a.toward + b.toward, -2.0 * slack);
  c.arcs[1] = arc_where(c, a.walls[0], -slack);
  c.arcs[2] = arc_where(c, a.walls[1], -slack);
  c.arcs[3] = arc_where(c, b.walls[0], -slack);
  c.arcs[4] = arc_where(c, b.walls[1], -slack);
  return c;
}

vec3 arc_of_spokes(Circle c, Leaving edge, float error) {
  return arc_where(c, edge.arc.xyz, cosine(min(edge.arc.w, 3.1415926)) - error);
}

// Spokes s to the edge, at t along it, with D the distance: x = t u - D s, and x.h = D gives t (u.h) = D (1 + s.h).
Circle where_edge_and_face_meet(Leaving edge, Leaving face, float sine) {
  float error = direction_error(edge, face), slack = 10.0 * error, rise = dot(edge.along, face.toward);
  Circle c = circle_across(edge.along);
  c.arcs[0] = arc_of_spokes(c, edge, 2.0 * error);
  c.arcs[1] = arc_where(c, face.toward, 2.0 * sine * sine - 1.0 - slack);
  for (uint k = 0u; k < 2u; ++k) {
    float along = dot(face.walls[k], edge.along);
    c.arcs[2u + k] = arc_where(c, along * face.toward - rise * face.walls[k], -along - slack);
  }
  c.arcs[4] = rise < -slack ? kNowhere : kWholeCircle;
  return c;
}

// Both feet are at the same distance: t = -D s.v / (1 - u.v), where s is the spoke to the first; the other spoke is s +
// (t/D) (v - u).
Circle where_edges_meet(Leaving a, Leaving b, float sine) {
  float error = direction_error(a, b), apart = max(0.0, 1.0 - dot(a.along, b.along));
  Circle c = circle_across(a.along);
  c.arcs[0] = arc_of_spokes(c, a, 2.0 * error);
  c.arcs[1] = arc_where(c, -b.along, sine * sqrt(2.0 * max(0.0, apart - 2.0 * error)) - 2.0 * error);
  // For an edge between two faces that nearly touch, nothing is known of the spokes: its arc has no middle across it.
  bool has_arc = b.arc.w < 3.1415926;
  vec3 condition = arc_where(c, apart * b.arc.xyz + dot(a.along, b.arc.xyz) * b.along,
                             apart * cosine(min(b.arc.w, 3.1415926)) - 10.0 * error);
  c.arcs[2] = has_arc ? condition : kWholeCircle;
  return c;
}

bool is_corner_of(uint name, uint k) {
  uint kind = name % 8u;
  bool is_edge = kind >= kFirstEdge && kind < kFirstCorner;
  return is_edge ? (k + 1u) % 3u != kind - kFirstEdge : kind == kFace || kind == kFront;
}

// True if the carriers have no corner in common.
bool can_meet_at_corner(uint first, uint second, float sine) {
  uvec4 a = corners_and_flags(first / 8u), b = corners_and_flags(second / 8u);
  if (((distrust_of(a.w) | distrust_of(b.w)) & kLinkWhole) != 0u) return true;
  uint i = 3u, j = 3u;
  for (uint k = 0u; k < 9u; ++k) {
    bool common_corner = is_corner_of(first, k / 3u) && is_corner_of(second, k % 3u) && a[k / 3u] == b[k % 3u];
    i = common_corner ? k / 3u : i;
    j = common_corner ? k % 3u : j;
  }
  if (i == 3u) return true;
  Leaving from_a, from_b;
  // A loop, and one call for the three kinds of pairs, so that drivers translate the code once.
  for (uint k = 0u; k < 2u;) {
    from_a = from_b;
    from_b = leaving(k == 0u ? first : second, k == 0u ? i : j);
    if (++k == 2u) break;
  }
  Circle c;
  if (from_a.is_face && from_b.is_face) {
    c = where_faces_meet(from_a, from_b);
  } else if (!from_a.is_face && !from_b.is_face) {
    c = where_edges_meet(from_a, from_b, sine);
  } else {
    Leaving edge = from_a, face = from_b;
    if (from_a.is_face) {
      edge = from_b;
      face = from_a;
    }
    c = where_edge_and_face_meet(edge, face, sine);
  }
  return have_common_point(c.arcs);
}

#endif
