#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Determines the parent's contacts that are contacts of each child: Lemma A (docs/theory.md) with two witnesses and
// Lemma L, for the ball that the child's list must serve, and, sharper, for the cube itself, since dismissal reads only
// contacts that touch it. One invocation per parent and child; one bit per list entry. The eight children of a parent
// walk one list, and find the triangle nearest to their centre, and a partner for it: the contact whose sheet with it
// passes the centre closest.
//
// The last round also attempts dismissal (axis_test.glsl) by the first available axis, the normal of the first witness:
// a child is dropped if all contacts obey it, is kept if the one that obeys least and the nearest one can obey no
// common axis, and is otherwise left open for dismiss_cells.comp. The remaining children determine their side if the
// nearest triangles decide it (docs/theory.md, "Outside").
#include "lanes/lanes.glsl"
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 12
#include "tree/triangles.glsl"
#include "certified/axis_test.glsl"
#include "certified/witness.glsl"

layout(set = 0, binding = 1) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) buffer Nearest { uvec2 nearest[]; };  // distance from the centre (bits), triangle
layout(set = 0, binding = 5) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 6) writeonly buffer TouchMasks { uint touch_masks[]; };
// Contacts; those that touch the cube; of these the one whose normal is farthest from that of the witness, and finally
// the cell's partner; flags of the contacts seen (kSeen*).
layout(set = 0, binding = 7) buffer Counts { uvec4 counts[]; };
// Sum of the normals of the contacts that touch; w: least cosine between one of them and that of the first witness.
layout(set = 0, binding = 8) buffer Axes { vec4 axes[]; };
layout(set = 0, binding = 9) buffer States { uvec4 states[]; };  // kept, list entries, mask words, flags
layout(set = 0, binding = 10) writeonly buffer Open { uint open[]; };
layout(set = 0, binding = 11) writeonly buffer Requests { uint requests[]; };

const uint kSeenUntrusted = 1u;  // a contact that touches has no trusted normal
// The centre is not clearly behind, or not clearly in front of, one of the triangles that may be the nearest.
const uint kSeenInFront = 2u, kSeenBehind = 4u;

Witness witness_of(vec3 centre, uint name) {
  TriangleTexels texels = load_triangle(name);
  Witness w = witness_at(name, vector_to_triangle(centre, texels));
  [[unroll]] for (uint k = 0; k < 8u; ++k)
    w.to_corner[k] = sqrt(squared_distance_to_triangle(centre + step.touch_half_side * corner_sign(k), texels));
  return w;
}

// The triangle that lane k of the eight has loaded, from entry `list_entry`.
TriangleTexels triangle_of_lane(TriangleTexels mine, uint list_entry, uint k) {
#ifdef LOCKSTEP
  return TriangleTexels(from_lane(mine.a, k), from_lane(mine.ab, k), from_lane(mine.ac, k), from_lane(mine.normal, k));
#else
  return load_triangle(lists[list_entry]);
#endif
}

uint name_of_lane(uint mine, uint list_entry, uint k) {
#ifdef LOCKSTEP
  return from_lane(mine, k);
#else
  return lists[list_entry];
#endif
}

// Number of entries over which a second walk fits the loop budget (docs/reliability.md): without shuffles a walk takes
// nine iterations for eight entries.
#ifdef LOCKSTEP
const uint kMostWalkedTwice = kEntriesPerRound;
#else
const uint kMostWalkedTwice = kEntriesPerRound / 2u;
#endif

// The contacts of the parent among which witnesses are sought: the first ones touch its cube, and the nearest triangle
// to any point of the cube, such as the child's centre, is one of them. (For other points any witness suffices.)
uint candidates_of(Cell parent) { return parent.touching != 0u ? parent.touching : parent.list_count; }

// The nearest to p of these, or of a sample of them. All eight lanes call it, each with its own p.
uint witness_near(Cell parent, uint lane, vec3 p) {
  uint stride = 1u + candidates_of(parent) / kWitnessSample;
  uint last = parent.list_begin + candidates_of(parent) - 1u;
  uint best_name = 0u;
  float best = 3e38;
  for (uint entry = parent.list_begin; entry <= last;) {
    uint mine_name = lists[min(entry + lane * stride, last)];
    TriangleTexels mine = load_triangle(mine_name);
    for (uint k = 0; k < kLanes; ++k) {
      uint list_entry = min(entry + k * stride, last);
      // Both in all lanes: a choice between calls may be a branch, and shuffles need all lanes.
      float d = squared_distance_to_triangle(p, triangle_of_lane(mine, list_entry, k));
      uint name = name_of_lane(mine_name, list_entry, k);
      best_name = d < best ? name : best_name;
      best = min(best, d);
    }
    entry += kLanes * stride;
    if (entry > last) break;
  }
  return best_name;
}

// For a triangle that may be the nearest: its possible sides for the centre, given the distance of the centre behind
// its plane.
uint sides_seen(float depth, bool trusted) {
  float clear = 4.0 * step.slack;
  return (trusted && depth > clear ? 0u : kSeenInFront) | (trusted && depth < -clear ? 0u : kSeenBehind);
}

// The result of a walk over the entries of a list: the values of Counts, Axes and Nearest, and the partner.
struct Marks {
  uvec4 count;
  vec4 axis;
  uvec2 first;
  uint partner;
};

Marks mark(Cell parent, uint child, vec3 centre, Witness front, Witness back, Prism prism, uint entry, uint end,
           Marks marks) {
  vec3 front_normal = triangle_texel(4u * front.name + 3u).xyz;
  uint base = 8u * parent.word_begin + child * ((parent.list_count + 31u) / 32u);
  uint word = 0, touch_word = 0;
  float partner_away = 3e38, least_turn = sin(dismissal_angle(front.distance));
  marks.partner = kNoTriangle;
  while (entry < end) {
    uint next = parent.list_begin + entry, last = parent.list_begin + end - 1u;
    uint mine_name = lists[min(next + child, last)];
    TriangleTexels mine = load_triangle(mine_name);
    FOR_EACH_LANE(k) {
      TriangleTexels texels = triangle_of_lane(mine, min(next + k, last), k);
      uint name = name_of_lane(mine_name, min(next + k, last), k);
      vec3 v = vector_to_triangle(centre, texels);
      float d = length(v);
      vec3 g = v / max(d, 1e-30);
      vec4 along = corners_along(step.touch_half_side * g);
      bool near_front = is_contact(front, d, g), near_back = is_contact(back, d, g);
      bool near_prism = is_contact(prism, v, texels.normal), is_entry = entry + k < end;
      bool contact = near_front && near_back && near_prism && is_entry;
      bool cube_by_front = touches_cube(front, d, along), cube_by_back = touches_cube(back, d, along);
      bool cube_by_prism = touches_cube(prism, v, texels.normal);
      bool touches = contact && cube_by_front && cube_by_back && cube_by_prism;
      uint bit = 1u << (entry + k & 31u);
      word |= contact ? bit : 0u;
      touch_word |= touches ? bit : 0u;
      bool trusted = texels.normal.w > 0.5;
      float cosine = trusted ? dot(texels.normal.xyz, front_normal) : -2.0;
      bool is_lesser = cosine < marks.axis.w, is_least = touches && is_lesser;
      marks.count.z = is_least ? name : marks.count.z;
      // The sheet between the two is about (D_t - D_0) / |g_t - g_0| from the centre (equation 2.11).
      float turn = length(g - front.direction);
      float away = (d - front.distance) / max(turn, 1e-30) - 0.2 * step.circumradius * turn;
      bool turns_enough = turn >= least_turn, is_closer = away < partner_away;
      bool is_partner = touches && turns_enough && is_closer;
      marks.partner = is_partner ? name : marks.partner;
      partner_away = is_partner ? away : partner_away;
      marks.count.w |= touches && !trusted ? kSeenUntrusted : 0u;
      // In the end, of all triangles that may be the nearest: those before a clearly nearer one are discarded.
      float behind_first = d - uintBitsToFloat(marks.first.x);
      marks.count.w &= behind_first < -6.0 * step.slack ? ~(kSeenInFront | kSeenBehind) : 0xffffffffu;
      marks.count.w |= behind_first <= 6.0 * step.slack ? sides_seen(dot(v, texels.normal.xyz), trusted) : 0u;
      marks.first = behind_first < 0.0 ? uvec2(floatBitsToUint(d), name) : marks.first;
      marks.axis.xyz += touches ? texels.normal.xyz : vec3(0.0);
      marks.axis.w = touches ? min(marks.axis.w, cosine) : marks.axis.w;
    }
    entry += 8u;
    if ((entry & 31u) == 0u || entry >= end) {
      uint w = base + (min(entry, end) - 1u) / 32u;
      masks[w] = word;
      touch_masks[w] = touch_word;
      marks.count.xy += uvec2(bitCount(word), bitCount(touch_word));
      word = 0;
      touch_word = 0;
    }
    if (entry >= end) break;
  }
  return marks;
}

void store(uint item, Marks marks, bool is_last) {
  counts[item] = uvec4(marks.count.xy, is_last ? marks.partner : marks.count.z, marks.count.w);
  axes[item] = marks.axis;
  nearest[item] = marks.first;
  if (!is_last) states[item].x = marks.partner;  // until settle()
}

Marks stored(uint item) { return Marks(counts[item], axes[item], nearest[item], states[item].x); }

// For the eight children of a parent, if they walk together.
bool is_so_of_any(bool mine) {
#ifdef LOCKSTEP
  return or_of_lanes(mine ? 1u : 0u) != 0u;
#else
  return mine;
#endif
}

// True if the centre is behind the witness.
bool is_behind(Witness w) {
  vec4 normal = triangle_texel(4u * w.name + 3u);
  return (sides_seen(w.distance * dot(w.direction, normal.xyz), normal.w > 0.5) & kSeenInFront) == 0u;
}

// Decides about a child, once all contacts have been seen.
void settle(uint item, vec3 centre, uint parent_flags, Marks marks) {
  COUNT(kVisitedCount, 1u);
  uvec4 count = marks.count;
  float nearest_distance = uintBitsToFloat(marks.first.x), theta = dismissal_angle(nearest_distance);
  bool is_empty = marks.axis.w > cosine(theta) + kAxisSlack;
  uint flags = parent_flags & kCellInside;
  if ((count.w & kSeenUntrusted) != 0u && nearest_distance <= step.circumradius) flags |= kCellUntrusted;
  bool needs_side = must_decide_side(flags, nearest_distance);
  if (needs_side && step.open_edges == 0u) {
    bool inside = (count.w & kSeenInFront) == 0u, outside = (count.w & kSeenBehind) == 0u;
    flags |= inside ? kCellInside : 0u;
    is_empty = is_empty || outside;
    needs_side = !inside;
  }
  states[item] = is_empty ? uvec4(0u) : uvec4(1u, count.x, (count.x + 31u) / 32u, flags);
  bool is_kept = !is_empty && incompatible(obedience_of(marks.first.y, centre, theta),
                                           obedience_of(count.z, centre, theta));
  // In any order: every result is written to its own state.
  if (!is_empty && !is_kept) open[atomicAdd(counters[kOpen], 1u)] = item;
  if (is_kept && needs_side) requests[atomicAdd(counters[kRequests], 1u)] = item;
}

void main() {
  uint item = invocation_index();
  if (item >= 8u * counters[kParents]) return;
  Cell parent = parents[item / 8];
  uint child = item % 8, begin = step.first_entry;
  // The child was found empty when its list was to be written: it has no children, and none of the counted queries.
  if (parent.list_count == 0u && begin == 0u) {
    states[item] = uvec4(0u);
    atomicAdd(counters[kQueries], 0xffffffffu);
  }
  if (begin >= parent.list_count) return;
  uvec3 coordinates = child_coordinates(parent, child);
  vec3 centre = cell_centre(coordinates);
  // On the other side of a sheet that may pass: the parent's partner, if it has one. All eight children use the same.
  bool seeks = parent.partner == kNoTriangle;
  Witness front = witness_of(centre, witness_near(parent, child, centre));
  uint back_name = seeks ? witness_near(parent, child, centre - step.circumradius * front.direction) : parent.partner;
  Witness back = witness_of(centre, back_name);
  uint end = min(parent.list_count, begin + kEntriesPerRound);
  bool is_first = begin == 0u, is_last = end >= parent.list_count;
  Marks before = Marks(uvec4(0u), vec4(0.0, 0.0, 0.0, 2.0), uvec2(kFarthestBits, 0u), kNoTriangle);
  if (!is_first) before = stored(item);
  // Whether Lemma L applies is known only from the nearest triangle, at the end. A witness from a sample may give too
  // large a bound: the cell is then marked once more without it, which is rare if only half of the bound is used.
  float bound = candidates_of(parent) < kWitnessSample ? front.distance : 0.5 * front.distance;
  bool may_walk_twice = is_first && is_last && parent.list_count <= kMostWalkedTwice;
  bool in_parent = (parent.flags & kCellInside) != 0u, may_be_inside = in_parent || is_behind(front);
  Prism prism = prism_at(front.distance, may_walk_twice && may_be_inside && clears_boundary(bound));
  uint candidates = candidates_of(parent), sampled = candidates / (1u + candidates / kWitnessSample);
  for (uint walks = 1u;; ++walks) {
    Marks marks = mark(parent, child, centre, front, back, prism, begin, end, before);
    bool is_inside = in_parent || (marks.count.w & kSeenInFront) == 0u;
    bool is_wrong = prism.is_tested && !(is_inside && clears_boundary(uintBitsToFloat(marks.first.x)));
    prism.is_tested = prism.is_tested && !is_wrong;
    if (is_so_of_any(is_wrong)) continue;
    // Inside the loop, as the walks of other lanes of its vector may change the values of a lane after it has left the
    // loop (docs/reliability.md).
    store(item, marks, is_last);
    if (!is_last) break;
    if (child == 0u) COUNT_TESTS(8u * (walks * parent.list_count + (seeks ? 2u : 1u) * sampled));
    if (is_searched(coordinates))
      settle(item, centre, parent.flags, marks);
    else
      states[item] = uvec4(0u);
    break;
  }
}
