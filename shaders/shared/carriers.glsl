// The carriers of a box: the faces, edges and vertices on which the spokes of its medial points can end
// (docs/theory.md, Lemmas A, C and D). A workgroup gathers them, nearest first. Include after "triangles.glsl" and after
// declaring `cells`, `lists`, `links` and `corner_cones`.
#ifndef MEDIAL_VK_CARRIERS_GLSL
#define MEDIAL_VK_CARRIERS_GLSL

const uint kMostCarriers = 128u;  // boxes with more are not decided
const uint kMostEntries = 8192u;  // nor are those with longer lists
// What kind of carrier, in the low bits of its name: a trusted face, an edge 1 to 3, a vertex 4 to 6 of its triangle,
// or an untrusted triangle as a whole.
const uint kFace = 0u, kFirstEdge = 1u, kFirstCorner = 4u, kWhole = 7u;

const float kAngleSlack = 1e-5;   // of angles computed here
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
shared vec4 carrier_nearest[kMostCarriers];  // g, D
shared vec4 carrier_spokes[kMostCarriers];   // axis and half-angle of a cap
shared vec2 carrier_error[kMostCarriers];    // of the bound D - g.x: by rounding; above it, by bending (Lemma F)
// The plane, line or point that a carrier spans: the projection of the centre on it (from the centre) and how wrong
// that may be; a unit normal or direction, and which.
shared vec4 carrier_foot[kMostCarriers];
shared vec4 carrier_span[kMostCarriers];
const float kUnknownSpan = 0.0, kPlane = 1.0, kLine = 2.0, kPoint = 3.0;
shared float corner_distance[8];  // from the corners of the box to the triangle nearest to its centre
float farthest_corner;            // the greatest of them

// Lemma A for a box.
bool touches_box(vec3 v, float d, Box box) {
  vec3 h = box.half_sides * (v / max(d, 1e-30));
  float least = d - distance_slack(d, box.circumradius);
  if (farthest_corner + dot(abs(h), vec3(1.0)) < least) return false;
  for (uint k = 0; k < 8u; ++k)
    if (corner_distance[k] + dot(h, corner_sign(k)) >= least) return true;
  return false;
}

// Lists a carrier whose nearest point is at centre + v, unless Lemma A or C shows that no spoke ends there.
void add_carrier(vec3 v, vec4 spokes, vec4 foot, vec4 span, float tilt, uint name, Box box) {
  float d = length(v);
  if (!touches_box(v, d, box)) return;
  vec3 g = unit_or_zero(v);
  float rho = box.circumradius + 2.0 * step.slack;
  if (d > rho) {
    float wander = asin(rho / d) + tilt + kAngleSlack;
    float sum = wander + spokes.w;
    if (sum < 3.1 && dot(g, spokes.xyz) < cos(sum) - kCosineSlack) return;
    if (wander < spokes.w) spokes = vec4(g, wander);
  }
  uint slot = atomicAdd(carrier_count, 1u);
  if (slot >= kMostCarriers) return;
  carrier_name[slot] = name;
  carrier_nearest[slot] = vec4(g, d);
  carrier_spokes[slot] = spokes;
  float rho_squared = box.circumradius * box.circumradius;
  carrier_error[slot] = vec2(distance_slack(d, box.circumradius), 0.5 * rho_squared / max(d, 1e-30));
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
  vec4 arc = size > 0.05 ? vec4(sum / size, asin(min(1.0, 0.5 * length(texels.normal.xyz - other))) + kAngleSlack)
                         : vec4(0.0, 0.0, 1.0, 4.0);
  float size_e = max(length(e), 1e-30);
  vec3 u = e / size_e;
  float tilt = 1.2e-7 / size_e, sway = tilt * length(box.centre - a);
  float along = dot(box.centre - a, u), reach = dot(box.half_sides, abs(u)) + step.slack + sway;
  if (along < -reach || along > size_e + reach) return;  // no point of the box projects into the edge
  vec4 foot = vec4(a + along * u - box.centre, step.slack * (1.0 + box.circumradius / size_e) + sway);
  add_carrier(a + clamp(along, 0.0, size_e) * u - box.centre, arc, foot, vec4(u, kLine), tilt, 8u * t + kFirstEdge + k,
              box);
}

void add_carriers_of(uint t, Box box) {
  TriangleTexels texels = load_triangle(t);
  vec3 v = vector_to_triangle(box.centre, texels);
  if (!touches_box(v, length(v), box)) return;
  TriangleLinks l = links[t];
  if ((l.flags & kLinkWhole) != 0u || texels.normal.w < 0.5) {
    add_carrier(v, vec4(0.0, 0.0, 1.0, 4.0), vec4(v, 0.0), vec4(kUnknownSpan), tilt_of(texels), 8u * t + kWhole, box);
    return;
  }
  vec3 n = texels.normal.xyz;
  vec4 foot = vec4(n * dot(n, texels.a.xyz - box.centre), step.slack);
  add_carrier(v, vec4(n, kAngleSlack), foot, vec4(n, kPlane), tilt_of(texels), 8u * t + kFace, box);
  uint neighbour[3] = uint[3](l.neighbour_0, l.neighbour_1, l.neighbour_2);
  uint corner[3] = uint[3](l.corner_0, l.corner_1, l.corner_2);
  for (uint k = 0; k < 3u; ++k) {
    if ((l.flags & (kLinkEdge << k)) != 0u) add_edge(t, texels, k, neighbour[k], box);
    vec3 to_corner = corner_of(texels, k) - box.centre;
    if ((l.flags & (kLinkCorner << k)) != 0u)
      add_carrier(to_corner, corner_cones[corner[k]], vec4(to_corner, step.slack), vec4(kPoint), 0.0,
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
shared uint rivals[kRivals];
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
  if (lane == 0u) carrier_count = 0u;
  TriangleTexels nearest = load_triangle(cell.nearest);
  for (uint k = lane; k < 8u; k += gl_WorkGroupSize.x)
    corner_distance[k] = sqrt(squared_distance_to_triangle(box.centre + box.half_sides * corner_sign(k), nearest));
  barrier();
  farthest_corner = 0.0;
  for (uint k = 0; k < 8u; ++k) farthest_corner = max(farthest_corner, corner_distance[k]);
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

// Where a cell may hold a point that the radius threshold makes salient, smaller angles count too.
float threshold_angle(float nearest_distance, Box box) {
  bool deep = nearest_distance + box.circumradius + step.slack >= step.radius;
  return deep ? min(step.deep_angle, step.angle) : step.angle;
}

#endif
