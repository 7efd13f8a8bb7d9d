// The carriers of a box: the faces, edges and vertices on which the spokes of its medial points can end
// (docs/theory.md, Lemmas A, C, D and I). A workgroup of eight lanes gathers them, nearest first. Include after "lanes.glsl"
// and "links.glsl" and after declaring `cells` and `lists`.
#ifndef MEDIAL_VK_CARRIERS_GLSL
#define MEDIAL_VK_CARRIERS_GLSL
#include "lanes/angles.glsl"

const uint kMostCarriers = 128u;  // boxes with more are not decided
const uint kMostEntries = 4096u;  // nor are those with more contacts
// Number of contacts whose features are listed at a time, and of features per contact: at most two sides of a face,
// three edges, three vertices.
const uint kEntriesAtOnce = 64u, kMostFeatures = 8u * kEntriesAtOnce;
// The kind of a carrier, in the low bits of its name: a face touched from behind, an edge (1 to 3) or a vertex (4 to 6)
// of its triangle, or an untrusted face touched from the front, which also represents a whole triangle without a good
// normal.
const uint kFace = 0u, kFirstEdge = 1u, kFirstCorner = 4u, kFront = 7u;

const float kAngleSlack = 1e-5;   // of angles computed here
const float kCosineSlack = 1e-6;  // of dot products of unit vectors

// Some triangle of the mesh is not trusted. Otherwise the code for untrusted triangles is not translated.
layout(constant_id = 1) const bool kHasUntrusted = true;

// Those of the flags kLinkWhole and kLinkBothSides that a triangle has.
uint distrust_of(uint flags) { return kHasUntrusted ? flags & (kLinkWhole | kLinkBothSides) : 0u; }

struct Box {
  vec3 centre, half_sides;
  float circumradius;
};

shared uint feature_count;
shared uint feature_name[kMostFeatures];
shared uint carrier_count;
shared uint carrier_name[kMostCarriers];
shared vec4 carrier_nearest[kMostCarriers];  // g, D
shared vec4 carrier_spokes[kMostCarriers];   // axis and half-angle of a cap
// Nearest first, and by name among equals, so that results do not depend on the order of the atomics; later without the
// carriers that others beat everywhere.
shared uint ranked[kMostCarriers];
shared uint carrier_order[kMostCarriers];
uint kept_count;  // of carrier_order; the same in all lanes

// The plane, line or point that a carrier spans.
const float kUnknownSpan = 0.0, kPlane = 1.0, kLine = 2.0, kPoint = 3.0;

float corner_distance[8];  // from the corners of the box to the triangle nearest to its centre

// Bound of the rounding of distances, feet and chords of the contacts listed so far (docs/theory.md, "Rounding"). Near
// the centre it is far less than step.slack, which holds for any two points of the unit box.
float near_slack;  // the same in all lanes
shared uint near_slack_bits;
const float kVertexSlack = 2.5e-7, kReachSlack = 1e-6;

float slack_of(TriangleTexels t, Box box) {
  float reach = distance(box.centre, t.a.xyz) + length(t.ab.xyz) + length(t.ac.xyz);  // at least that with any edge
  return min(step.slack, kVertexSlack + kReachSlack * reach);
}

// As distance_slack().
float near_distance_slack(float d, float circumradius) { return 4.0 * near_slack * (1.0 + circumradius / max(d, 1e-30)); }

// Lemma A for a box.
bool touches_box(vec3 v, float d, Box box) {
  vec4 along = corners_along(box.half_sides * (v / max(d, 1e-30)));
  return d - near_distance_slack(d, box.circumradius) <= most_at_corners(corner_distance, along);
}

// A candidate for a carrier.
struct Feature {
  vec3 nearest;  // vector from the centre of the box to its nearest point
  vec4 spokes;   // axis and half-angle of a cap
  vec4 foot;     // projection of the centre onto its span, from the centre; w: bound of its error
  vec4 span;     // unit normal or direction of the span; w: its kind
  float tilt;    // greatest turn of it by rounding
  bool meets;    // false: no point of the box projects into it, or lies on its side
};

Feature face_feature(TriangleTexels texels, uint flags, bool front, Box box) {
  vec3 v = vector_to_triangle(box.centre, texels), n = texels.normal.xyz;
  bool whole = (distrust_of(flags) & kLinkWhole) != 0u;
  float behind = dot(n, texels.a.xyz - box.centre), reach = dot(box.half_sides, abs(n)) + near_slack;
  Feature f = Feature(v, vec4(0.0, 0.0, 1.0, 4.0), vec4(v, 0.0), vec4(kUnknownSpan), tilt_of(texels), true);
  f.spokes = whole ? f.spokes : vec4(front ? -n : n, kAngleSlack);
  f.foot = whole ? f.foot : vec4(n * behind, near_slack);
  f.span = whole ? f.span : vec4(n, kPlane);
  f.meets = (distrust_of(flags) & kLinkBothSides) == 0u || (front ? -behind : behind) >= -reach;
  return f;
}

vec3 corner_of(TriangleTexels t, uint k) { return t.a.xyz + (k == 1u ? t.ab.xyz : k == 2u ? t.ac.xyz : vec3(0.0)); }

// The spokes to an edge of a triangle with this normal: the middle of their arc and half of it. `neighbour`: the
// triangle across the edge, or, with `has_arc`, the row of the arc.
vec4 edge_arc(vec3 normal, uint neighbour, bool has_arc) {
  vec3 other = has_arc ? normal : triangle_texel(4u * neighbour + 3u).xyz;
  vec3 sum = normal + other;
  float size = length(sum);
  // Knife edges: the arc between opposite normals has no axis that float can determine.
  vec4 arc = size > 0.05 ? vec4(sum / size, arcsine(min(1.0, 0.5 * length(normal - other))) + kAngleSlack)
                         : vec4(0.0, 0.0, 1.0, 4.0);
  if (has_arc) arc = corner_cap(neighbour);
  return arc;
}

Feature edge_feature(TriangleTexels texels, uint k, uint neighbour, bool has_arc, Box box) {
  vec3 a = corner_of(texels, k), e = corner_of(texels, k == 2u ? 0u : k + 1u) - a;
  vec4 arc = edge_arc(texels.normal.xyz, neighbour, has_arc);
  float size_e = max(length(e), 1e-30);
  vec3 u = e / size_e;
  float tilt = 1.2e-7 / size_e, sway = tilt * length(box.centre - a);
  float along = dot(box.centre - a, u), reach = dot(box.half_sides, abs(u)) + near_slack + sway;
  vec4 foot = vec4(a + along * u - box.centre, near_slack * (1.0 + box.circumradius / size_e) + sway);
  return Feature(a + clamp(along, 0.0, size_e) * u - box.centre, arc, foot, vec4(u, kLine), tilt,
                 along >= -reach && along <= size_e + reach);
}

Feature corner_feature(TriangleTexels texels, uint k, vec4 cone, Box box) {
  vec3 v = corner_of(texels, k) - box.centre;
  return Feature(v, cone, vec4(v, near_slack), vec4(kPoint), 0.0, true);
}

// All three kinds are computed and one is selected: lanes hold different kinds, so every branch would be executed
// anyway.
Feature feature_named(uint name, Box box) {
  uint t = name / 8u, kind = name % 8u;
  bool is_edge = kind >= kFirstEdge && kind < kFirstCorner, is_corner = kind >= kFirstCorner && kind < kFront;
  uint k = is_edge ? kind - kFirstEdge : is_corner ? kind - kFirstCorner : 0u;
  TriangleTexels texels = load_triangle(t);
  uvec4 links = corners_and_flags(t);
  bool has_arc = is_edge && (distrust_of(links.w) & kLinkBothSides) != 0u;
  Feature face = face_feature(texels, links.w, kind == kFront, box);
  Feature edge = edge_feature(texels, k, is_edge ? neighbour_of(t, k) : t, has_arc, box);
  Feature corner = corner_feature(texels, k, corner_cap(links[k]), box);
  Feature f = face;
  f.nearest = is_edge ? edge.nearest : is_corner ? corner.nearest : face.nearest;
  f.spokes = is_edge ? edge.spokes : is_corner ? corner.spokes : face.spokes;
  f.foot = is_edge ? edge.foot : is_corner ? corner.foot : face.foot;
  f.span = is_edge ? edge.span : is_corner ? corner.span : face.span;
  f.tilt = is_edge ? edge.tilt : is_corner ? corner.tilt : face.tilt;
  f.meets = is_edge ? edge.meets : is_corner || face.meets;
  return f;
}

// Lists a feature as a carrier, unless Lemma A or C shows that no spoke ends there.
void add_carrier(Feature f, uint name, Box box) {
  float d = length(f.nearest);
  vec3 g = unit_or_zero(f.nearest);
  float rho = box.circumradius + 2.0 * near_slack;
  bool outside = d > rho;
  float wander = (outside ? arcsine(rho / d) : 4.0) + f.tilt + kAngleSlack;
  float sum = wander + f.spokes.w;
  bool turned_away = outside && sum < 3.1 && dot(g, f.spokes.xyz) < cosine(sum) - kCosineSlack;
  if (!f.meets || turned_away || !touches_box(f.nearest, d, box)) return;
  uint slot = atomicAdd(carrier_count, 1u);
  if (slot >= kMostCarriers) return;
  carrier_name[slot] = name;
  carrier_nearest[slot] = vec4(g, d);
  carrier_spokes[slot] = outside && wander < f.spokes.w ? vec4(g, wander) : f.spokes;
}

// Names those features of one contact that may carry spokes.
void list_features(uint t) {
  uint flags = corners_and_flags(t).w;
  uint kinds = 1u << kFace | (flags & 7u) << kFirstEdge | (flags >> 3u & 7u) << kFirstCorner;
  kinds |= (distrust_of(flags) & kLinkBothSides) != 0u ? 1u << kFront : 0u;
  kinds = (distrust_of(flags) & kLinkWhole) != 0u ? 1u << kFront : kinds;
  uint slot = atomicAdd(feature_count, uint(bitCount(kinds)));
  while (kinds != 0u) {
    feature_name[slot++] = 8u * t + uint(findLSB(kinds));
    kinds &= kinds - 1u;
  }
}

struct Carrier {
  uint name;
  vec4 nearest;
  vec4 spokes;
};

Carrier load_carrier(uint slot) {
  return Carrier(carrier_name[slot], carrier_nearest[slot], carrier_spokes[slot]);
}

// Carriers are arranged in rows of eight, one for each lane. The carrier of lane k in `row`, whose slots are the
// `count` entries of `order` from `first` on; beyond them, the last one.
#ifdef LOCKSTEP
#define CARRIER_OF_LANE(row, order, count, first, k) \
  Carrier(from_lane(row.name, k), from_lane(row.nearest, k), from_lane(row.spokes, k))
#else
#define CARRIER_OF_LANE(row, order, count, first, k) load_carrier(order[min((first) + (k), (count) - 1u)])
#endif

uint row_count(uint carriers) { return (carriers + kLanes - 1u) / kLanes; }

// Writes the slots of the carriers, nearest first, to `ranked`.
void rank_carriers(uint lane) {
  uint rows = row_count(carrier_count);
  for (uint a = 0; a < rows; ++a) {
    uint i = kLanes * a + lane, name = carrier_name[i], rank = 0u;
    float mine = carrier_nearest[i].w;
    for (uint b = 0; b < rows; ++b) {
      uint first = kLanes * b;
      float theirs = carrier_nearest[first + lane].w;
      uint their_name = carrier_name[first + lane];
      for (uint k = 0; k < kLanes; ++k) {
#ifdef LOCKSTEP
        float other = from_lane(theirs, k);
        uint other_name = from_lane(their_name, k);
#else
        float other = carrier_nearest[first + k].w;
        uint other_name = carrier_name[first + k];
#endif
        bool before = other < mine || (other == mine && other_name < name);
        rank += before && first + k < carrier_count ? 1u : 0u;
      }
    }
    if (i < carrier_count) ranked[rank] = i;
  }
}

const uint kRivals = 4u, kPairRivals = 8u;  // the nearest carriers, tried as rivals of one other, or of a pair

// Bound of the error of the estimate D - g.x: x for rounding; y for bending, where it is an upper bound (Lemma F).
vec2 error_of(Carrier c, Box box) {
  float rho = box.circumradius, d = c.nearest.w;
  return vec2(near_distance_slack(d, rho), 0.5 * rho * rho / max(d, 1e-30));
}

// Lemma F: true if a rival is nearer than the mixture of two others wherever these are equally near.
bool beats(Carrier rival, vec4 mixture, float slack, Box box) {
  vec4 ahead = mixture - rival.nearest;
  vec2 error = error_of(rival, box);
  return ahead.w - 3.0 * max(slack, error.x) > dot(box.half_sides, abs(ahead.xyz)) + error.y;
}

// For all lanes. Lemma F with one carrier instead of a pair: a carrier is omitted if another is nearer everywhere in
// the box.
void order_unbeaten(uint lane, Box box) {
  kept_count = 0u;
  Carrier nearest_row = load_carrier(ranked[min(lane, carrier_count - 1u)]);
  for (uint first = 0; first < carrier_count; first += kLanes) {
    uint slot = ranked[min(first + lane, carrier_count - 1u)];
    Carrier mine = load_carrier(slot);
    float slack = error_of(mine, box).x;
    bool keep = first + lane < carrier_count;
    for (uint k = 0; k < min(kRivals, carrier_count); ++k) {
      Carrier rival = CARRIER_OF_LANE(nearest_row, ranked, carrier_count, 0u, k);
      keep = keep && (k >= first + lane || !beats(rival, mine.nearest, slack, box));
    }
    uint kept = or_of_lanes(keep ? 1u << lane : 0u);
    if (keep) carrier_order[kept_count + uint(bitCount(kept & ((1u << lane) - 1u)))] = slot;
    kept_count += uint(bitCount(kept));
  }
  synchronize();
}

// Lists the features of those contacts that touch the cell (the first of its list), then the features that carry
// spokes. The work is divided into two passes so that all lanes are busy in the second, expensive one.
void list_carriers(uint lane, Cell cell, Box box) {
  uint begin = 0u;
  while (carrier_count <= kMostCarriers) {
    uint end = min(begin + kEntriesAtOnce, cell.touching);
    float mine = 0.0;
    for (uint i = begin + lane; i < end; i += kLanes) {
      uint t = lists[cell.list_begin + i];
      mine = max(mine, slack_of(load_triangle(t), box));
      list_features(t);
    }
    atomicMax(near_slack_bits, floatBitsToUint(mine));
    synchronize();
    near_slack = uintBitsToFloat(near_slack_bits);
    for (uint i = lane; i < feature_count; i += kLanes) {
      uint name = feature_name[i];
      add_carrier(feature_named(name, box), name, box);
    }
    synchronize();
    begin = end;
    if (begin >= cell.touching || carrier_count > kMostCarriers) return;
    if (lane == 0u) feature_count = 0u;
    synchronize();
  }
}

void measure_corners(uint lane, TriangleTexels nearest, Box box) {
#ifdef LOCKSTEP
  float mine = sqrt(squared_distance_to_triangle(box.centre + box.half_sides * corner_sign(lane), nearest));
  [[unroll]] for (uint k = 0; k < 8u; ++k) corner_distance[k] = from_lane(mine, k);
#else
  for (uint k = 0; k < 8u; ++k)
    corner_distance[k] = sqrt(squared_distance_to_triangle(box.centre + box.half_sides * corner_sign(k), nearest));
#endif
}

// For all lanes of the workgroup. False: there are too many.
bool gather_carriers(Cell cell, Box box) {
  uint lane = gl_LocalInvocationID.x;
  TriangleTexels nearest = load_triangle(cell.nearest);
  measure_corners(lane, nearest, box);
  synchronize();
  if (lane == 0u) {
    feature_count = 0u;
    carrier_count = 0u;
    near_slack_bits = floatBitsToUint(slack_of(nearest, box));
  }
  synchronize();
  kept_count = 0u;
  if (cell.touching > kMostEntries) return false;
  list_carriers(lane, cell, box);
  if (carrier_count > kMostCarriers) return false;
  if (carrier_count == 0u) return true;
  rank_carriers(lane);
  synchronize();
  order_unbeaten(lane, box);
  return true;
}

// In a cell that may hold a point that the radius threshold makes salient, smaller angles count too.
float threshold_angle(float nearest_distance, Box box) {
  bool deep = nearest_distance + box.circumradius + step.slack >= step.radius;
  return deep ? min(step.deep_angle, step.angle) : step.angle;
}

#endif
