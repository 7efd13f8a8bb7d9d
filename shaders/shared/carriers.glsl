// Dismissal by pairs (docs/theory.md, Lemmas D to F). A workgroup gathers the carriers of a box (the faces, edges and
// vertices on which the spokes of its medial points can end) and then looks for a pair that can hold two spokes of a
// salient one. Include after "triangles.glsl" and after declaring `cells`, `lists`, `links` and `corner_cones`.
#ifndef MEDIAL_VK_CARRIERS_GLSL
#define MEDIAL_VK_CARRIERS_GLSL

const uint kMostCarriers = 128u;  // boxes with more are not decided
const uint kMostEntries = 8192u;  // nor are those with longer lists
// What kind of carrier, in the low bits of its name: a trusted face, an edge 1 to 3, a vertex 4 to 6 of its triangle,
// or an untrusted triangle as a whole.
const uint kFace = 0u, kFirstEdge = 1u, kFirstCorner = 4u, kWhole = 7u;

const float kAngleSlack = 1e-5;   // of angles computed here
const float kLeastCosPhi = 0.25;  // sharper edges are not asked for chords: docs/theory.md, "Rounding"
const float kCosineSlack = 1e-6;  // of dot products of unit vectors

struct Box {
  vec3 centre, half_sides;
  float circumradius;
};

shared uint carrier_count;
shared uint carrier_name[kMostCarriers];
// Nearest first, and by name where they tie: results do not depend on the order of the atomics. Of those that others
// do not beat everywhere, there are kept_count.
shared uint carrier_order[kMostCarriers];
shared uint kept_count;
shared uint rivals[4];  // the nearest
shared vec4 carrier_nearest[kMostCarriers];  // g, D
shared vec4 carrier_spokes[kMostCarriers];   // axis and half-angle of a cap
shared vec2 carrier_error[kMostCarriers];    // of the bound D - g.x: by rounding; above it, by bending (Lemma F)
// The plane, line or point that a carrier spans: the projection of the centre on it (from the centre) and how wrong that
// may be; a unit normal or direction, and which.
shared vec4 carrier_foot[kMostCarriers];
shared vec4 carrier_span[kMostCarriers];
const float kUnknownSpan = 0.0, kPlane = 1.0, kLine = 2.0, kPoint = 3.0;
shared float corner_distance[8];             // from the corners of the box to the triangle nearest to its centre
shared float farthest_corner;                // the greatest of them
shared uint is_feasible;
// Pairs that may turn enough, packed so that all lanes have work: most pairs do not get that far.
const uint kQueueSize = 1024u;
shared uint queue[kQueueSize];
shared uint queue_count;

float slack_of(float d, Box box) { return 4.0 * step.slack * (1.0 + box.circumradius / max(d, 1e-30)); }

// Lemma A for a box.
bool touches_box(vec3 v, float d, Box box) {
  vec3 h = box.half_sides * (v / max(d, 1e-30));
  float least = d - slack_of(d, box);
  if (farthest_corner + dot(abs(h), vec3(1.0)) < least) return false;
  for (uint k = 0; k < 8u; ++k)
    if (corner_distance[k] + dot(h, corner_sign(k)) >= least) return true;
  return false;
}

// Lists a carrier whose nearest point is at centre + v, unless Lemma A or C shows that no spoke ends there.
void add_carrier(vec3 v, vec4 spokes, vec4 foot, vec4 span, uint name, Box box) {
  float d = length(v);
  if (!touches_box(v, d, box)) return;
  vec3 g = unit_or_zero(v);
  float rho = box.circumradius + 2.0 * step.slack;
  if (d > rho) {
    float wander = asin(rho / d) + kAngleSlack;
    float sum = wander + spokes.w;
    if (sum < 3.1 && dot(g, spokes.xyz) < cos(sum) - kCosineSlack) return;
    if (wander < spokes.w) spokes = vec4(g, wander);
  }
  uint slot = atomicAdd(carrier_count, 1u);
  if (slot >= kMostCarriers) return;
  carrier_name[slot] = name;
  carrier_nearest[slot] = vec4(g, d);
  carrier_spokes[slot] = spokes;
  carrier_error[slot] =
      vec2(slack_of(d, box), 0.5 * box.circumradius * box.circumradius / max(d, 1e-30));
  carrier_foot[slot] = foot;
  carrier_span[slot] = span;
}

vec3 corner_of(TriangleTexels t, uint k) { return t.a.xyz + (k == 1u ? t.ab.xyz : k == 2u ? t.ac.xyz : vec3(0.0)); }

void add_edge(uint t, TriangleTexels texels, uint k, uint neighbour, Box box) {
  vec3 a = corner_of(texels, k), e = corner_of(texels, k == 2u ? 0u : k + 1u) - a;
  vec3 other = triangle_texel(4u * neighbour + 3u).xyz;
  vec3 sum = texels.normal.xyz + other;
  float size = length(sum);
  // Knife edges: the arc between opposite normals has no axis that float can tell.
  vec4 arc = size > 1e-3 ? vec4(sum / size, asin(min(1.0, 0.5 * length(texels.normal.xyz - other))) + kAngleSlack)
                         : vec4(0.0, 0.0, 1.0, 4.0);
  float size_e = max(length(e), 1e-30);
  vec3 u = e / size_e;
  float along = dot(box.centre - a, u), reach = dot(box.half_sides, abs(u)) + step.slack;
  if (along < -reach || along > size_e + reach) return;  // no point of the box projects into the edge
  vec4 foot = vec4(a + along * u - box.centre, step.slack * (1.0 + box.circumradius / size_e));
  add_carrier(a + clamp(along, 0.0, size_e) * u - box.centre, arc, foot, vec4(u, kLine), 8u * t + kFirstEdge + k, box);
}

void add_carriers_of(uint t, Box box) {
  TriangleTexels texels = load_triangle(t);
  vec3 v = vector_to_triangle(box.centre, texels);
  if (!touches_box(v, length(v), box)) return;
  TriangleLinks l = links[t];
  if ((l.flags & kLinkWhole) != 0u || texels.normal.w < 0.5) {
    add_carrier(v, vec4(0.0, 0.0, 1.0, 4.0), vec4(v, 0.0), vec4(kUnknownSpan), 8u * t + kWhole, box);
    return;
  }
  vec3 n = texels.normal.xyz;
  vec4 foot = vec4(n * dot(n, texels.a.xyz - box.centre), step.slack);
  add_carrier(v, vec4(n, kAngleSlack), foot, vec4(n, kPlane), 8u * t + kFace, box);
  uint neighbour[3] = uint[3](l.neighbour_0, l.neighbour_1, l.neighbour_2);
  uint corner[3] = uint[3](l.corner_0, l.corner_1, l.corner_2);
  for (uint k = 0; k < 3u; ++k) {
    if ((l.flags & (kLinkEdge << k)) != 0u) add_edge(t, texels, k, neighbour[k], box);
    vec3 to_corner = corner_of(texels, k) - box.centre;
    if ((l.flags & (kLinkCorner << k)) != 0u)
      add_carrier(to_corner, corner_cones[corner[k]], vec4(to_corner, step.slack), vec4(kPoint),
                  8u * t + kFirstCorner + k, box);
  }
}

// Lemma F: is carrier c nearer than the mixture of two others wherever these tie?
bool beats(uint c, vec4 mixture, float slack, Box box) {
  vec4 ahead = mixture - carrier_nearest[c];
  vec2 error = carrier_error[c];
  return ahead.w - 3.0 * max(slack, error.x) > dot(box.half_sides, abs(ahead.xyz)) + error.y;
}

void rank_carriers(uint lane) {
  for (uint i = lane; i < carrier_count; i += gl_WorkGroupSize.x) {
    float mine = carrier_nearest[i].w;
    uint name = carrier_name[i], rank = 0;
    for (uint j = 0; j < carrier_count; ++j) {
      float other = carrier_nearest[j].w;
      rank += other < mine || (other == mine && carrier_name[j] < name) ? 1u : 0u;
    }
    carrier_order[rank] = i;
  }
}

const uint kRivals = 4u, kPairRivals = 8u;  // how many of the nearest are tried as the one that beats
const uint kBeaten = 0xffffffffu;

// Lemma F with one carrier in place of a pair: another is nearer everywhere in the box.
void drop_beaten(uint lane, Box box) {
  for (uint i = lane; i < carrier_count; i += gl_WorkGroupSize.x) {
    uint carrier = carrier_order[i];
    bool beaten = false;
    for (uint k = 0; k < min(kRivals, i) && !beaten; ++k)
      beaten = beats(rivals[k], carrier_nearest[carrier], carrier_error[carrier].x, box);
    if (beaten) carrier_order[i] = kBeaten;
  }
}

void pack_carriers() {
  uint count = 0;
  for (uint i = 0; i < carrier_count; ++i) {
    uint carrier = carrier_order[i];
    if (carrier != kBeaten) carrier_order[count++] = carrier;
  }
  kept_count = count;
}

// All lanes of the workgroup call this. False: too many.
bool gather_carriers(Cell cell, Box box) {
  uint lane = gl_LocalInvocationID.x;
  barrier();
  if (lane == 0u) {
    carrier_count = 0u;
    is_feasible = 0u;
  }
  TriangleTexels nearest = load_triangle(cell.nearest);
  for (uint k = lane; k < 8u; k += gl_WorkGroupSize.x)
    corner_distance[k] = sqrt(squared_distance_to_triangle(box.centre + box.half_sides * corner_sign(k), nearest));
  barrier();
  float farthest = 0.0;
  for (uint k = 0; k < 8u; ++k) farthest = max(farthest, corner_distance[k]);
  farthest_corner = farthest;  // the same of every lane
  if (cell.list_count <= kMostEntries)
    for (uint i = lane; i < cell.list_count; i += gl_WorkGroupSize.x) add_carriers_of(lists[cell.list_begin + i], box);
  barrier();
  if (cell.list_count > kMostEntries || carrier_count > kMostCarriers) return false;
  rank_carriers(lane);
  barrier();
  if (lane < min(kRivals, carrier_count)) rivals[lane] = carrier_order[lane];
  barrier();
  drop_beaten(lane, box);
  barrier();
  if (lane == 0u) pack_carriers();
  barrier();
  return true;
}

// Lemmas C and D: can their spokes be 2 theta apart?
bool can_turn(uint i, uint j, float theta) {
  float left = 2.0 * (theta - kAngleSlack) - carrier_spokes[i].w - carrier_spokes[j].w;
  return left <= 0.0 || dot(carrier_spokes[i].xyz, carrier_spokes[j].xyz) <= cos(left) + kCosineSlack;
}

// The normals between which the spokes to a face or an edge lie.
void normals_of(uint name, out vec3 first, out vec3 second) {
  uint t = name / 8u, kind = name % 8u;
  first = triangle_texel(4u * t + 3u).xyz;
  second = first;
  if (kind == kFace) return;
  TriangleLinks l = links[t];
  second = triangle_texel(4u * (kind == 1u ? l.neighbour_0 : kind == 2u ? l.neighbour_1 : l.neighbour_2) + 3u).xyz;
}

// The same without a cap, for faces and edges: distances on the sphere are convex below a right angle, so two spokes on
// two arcs differ by no more than some two ends, if those are closer than that.
bool can_turn_between_normals(uint i, uint j, float theta) {
  if (carrier_name[i] % 8u >= kFirstCorner || carrier_name[j] % 8u >= kFirstCorner) return true;
  vec3 a, b, c, d;
  normals_of(carrier_name[i], a, b);
  normals_of(carrier_name[j], c, d);
  float least = min(min(dot(a, c), dot(a, d)), min(dot(b, c), dot(b, d)));
  return least <= max(0.0, cos(2.0 * (theta - kAngleSlack))) + kCosineSlack;
}

// Where x goes when it is projected along with the centre.
vec3 project(vec4 span, vec3 x) {
  float along = dot(span.xyz, x);
  return span.w == kPlane ? x - along * span.xyz : span.w == kLine ? along * span.xyz : vec3(0.0);
}

// Lemma H: can the feet be as far apart as the object angle asks, 2 D sin(theta), anywhere in the box? D is bounded by
// a mixture of the two distances: the one whose gradient cancels best that of the feet's distance.
bool can_be_wide(uint i, uint j, float sine, Box box) {
  vec4 span_a = carrier_span[i], span_b = carrier_span[j];
  if (span_a.w == kUnknownSpan || span_b.w == kUnknownSpan) return true;
  vec4 a = carrier_nearest[i], b = carrier_nearest[j], ab = b - a;
  vec3 apart = carrier_foot[i].xyz - carrier_foot[j].xyz;
  vec3 pull = unit_or_zero(apart);
  pull = project(span_a, pull) - project(span_b, pull) + 2.0 * sine * a.xyz;
  float share = clamp(-dot(pull, ab.xyz) / max(2.0 * sine * dot(ab.xyz, ab.xyz), 1e-6), -2.0, 3.0);
  // Outside [0, 1] one distance counts negatively: Lemma F's upper bound of it.
  float excess = max(max(-share, share - 1.0), 0.0);
  float bend = excess * 0.5 * box.circumradius * box.circumradius / max(share < 0.0 ? b.w : a.w, 1e-30);
  float slack = 4.0 * (carrier_foot[i].w + carrier_foot[j].w) + (1.0 + 2.0 * excess) * slack_of(min(a.w, b.w), box);
  vec4 mixture = a + share * ab;
  [[unroll]] for (uint k = 0; k < 8u; ++k) {
    vec3 x = box.half_sides * corner_sign(k);
    vec3 chord = apart + project(span_a, x) - project(span_b, x);
    if (length(chord) + slack >= 2.0 * sine * (mixture.w - dot(mixture.xyz, x) - bend - slack)) return true;
  }
  return false;
}

// Corners of a carrier: edges repeat one, vertices two.
void corners_of(uint name, out vec3 p[3]) {
  TriangleTexels t = load_triangle(name / 8u);
  uint kind = name % 8u;
  vec3 a = t.a.xyz, b = corner_of(t, 1u), c = corner_of(t, 2u);
  bool is_edge = kind >= kFirstEdge && kind < kFirstCorner, is_corner = kind >= kFirstCorner && kind < kWhole;
  uint first = is_edge ? kind - kFirstEdge : is_corner ? kind - kFirstCorner : 0u;
  p[0] = first == 0u ? a : first == 1u ? b : c;
  p[1] = is_corner ? p[0] : first == 0u ? b : first == 1u ? c : a;
  p[2] = is_edge ? p[1] : is_corner ? p[0] : c;
}

// Lemma E at one end: what the chords must reach for an edge or a face, or a bound that all reach.
struct Facing {
  vec3 normal, other;
  float least;  // -n.c that a salient pair has
  bool asked;
};

Facing facing_of(uint name, float sine) {
  Facing f = Facing(vec3(0.0), vec3(0.0), 0.0, false);
  if (name % 8u >= kFirstCorner) return f;  // vertices and untrusted triangles
  normals_of(name, f.normal, f.other);
  float cos_phi = sqrt(max(0.0, 0.5 + 0.5 * dot(f.normal, f.other)));  // of the cap around both normals
  f.least = (sine - kCosineSlack) * cos_phi - kCosineSlack;
  f.asked = cos_phi >= kLeastCosPhi;
  return f;
}

// Lemma E: may both face each other along some chord?
bool can_face(uint i, uint j, float sine) {
  Facing a = facing_of(carrier_name[i], sine), b = facing_of(carrier_name[j], sine);
  if (!a.asked && !b.asked) return true;
  vec3 p[3], q[3], mean = vec3(0.0);
  corners_of(carrier_name[i], p);
  corners_of(carrier_name[j], q);
  [[unroll]] for (uint k = 0; k < 9u; ++k) mean += unit_or_zero(q[k % 3u] - p[k / 3u]);
  mean = unit_or_zero(mean);
  float most_a = -1.0, most_b = -1.0;
  bool behind_a = false, behind_b = false, bounded = true;
  [[unroll]] for (uint k = 0; k < 9u; ++k) {
    vec3 chord = q[k % 3u] - p[k / 3u];
    bool apart = dot(chord, chord) > 0.0;  // else a corner of both
    float along = dot(chord, mean) - step.slack;
    float depth_a = max(-dot(a.normal, chord), -dot(a.other, chord)) + step.slack;
    float depth_b = max(dot(b.normal, chord), dot(b.other, chord)) + step.slack;
    bounded = bounded && (!apart || along > 0.0);
    behind_a = behind_a || (apart && depth_a > 2.0 * step.slack);
    behind_b = behind_b || (apart && depth_b > 2.0 * step.slack);
    float inverse = apart ? 1.0 / max(along, 1e-30) : 0.0;
    most_a = max(most_a, depth_a * inverse);
    most_b = max(most_b, depth_b * inverse);
  }
  bool a_faces = !a.asked || (behind_a && (!bounded || most_a >= a.least));
  bool b_faces = !b.asked || (behind_b && (!bounded || most_b >= b.least));
  return a_faces && b_faces;
}

// Lemma F: a third carrier is nearer wherever these two tie.
bool is_beaten(uint i, uint j, Box box) {
  vec4 a = carrier_nearest[i], b = carrier_nearest[j];
  vec3 ab = b.xyz - a.xyz;
  float inverse = 1.0 / max(dot(ab, ab), 1e-30), slack = max(carrier_error[i].x, carrier_error[j].x);
  for (uint k = 0; k < min(kPairRivals, kept_count); ++k) {
    uint c = carrier_order[k];
    float share = clamp(dot(ab, carrier_nearest[c].xyz - a.xyz) * inverse, 0.0, 1.0);
    if (c != i && c != j && beats(c, mix(a, b, share), slack, box)) return true;
  }
  return false;
}

bool is_feasible_pair(uint i, uint j, float theta, float sine, Box box) {
  return can_turn(i, j, theta) && !is_beaten(i, j, box) && can_turn_between_normals(i, j, theta) &&
         can_be_wide(i, j, sine, box) && can_face(i, j, sine);
}

uint pair_count() { return kept_count * (max(kept_count, 1u) - 1u) / 2u; }

// The pairs (1, 0), (2, 0), (2, 1), (3, 0)... by their number: places in carrier_order, the second smaller.
uvec2 pair_at(uint p) {
  uint i = uint(0.5 + sqrt(2.0 * float(p) + 0.25));
  i = i * (i - 1u) / 2u > p ? i - 1u : (i + 1u) * i / 2u <= p ? i + 1u : i;
  return uvec2(i, p - i * (i - 1u) / 2u);
}

// All lanes: queues those of the kQueueSize pairs from `first` on that may turn enough.
void queue_pairs(uint first, float theta) {
  barrier();
  if (gl_LocalInvocationID.x == 0u) queue_count = 0u;
  barrier();
  uint end = min(first + kQueueSize, pair_count());
  for (uint p = first + gl_LocalInvocationID.x; p < end; p += gl_WorkGroupSize.x) {
    uvec2 pair = pair_at(p);
    if (can_turn(carrier_order[pair.x], carrier_order[pair.y], theta)) queue[atomicAdd(queue_count, 1u)] = p;
  }
  barrier();
}

// The carriers of a queued pair.
uvec2 queued(uint q) {
  uvec2 pair = pair_at(queue[q]);
  return uvec2(carrier_order[pair.x], carrier_order[pair.y]);
}

// Where a cell may hold a point that the radius threshold makes salient, smaller angles count too.
float threshold_angle(float nearest_distance, Box box) {
  bool deep = nearest_distance + box.circumradius + step.slack >= step.radius;
  return deep ? min(step.deep_angle, step.angle) : step.angle;
}

#endif
