#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The task of mark_contacts.comp for large cells, whose lists hold clusters: determines the parent's clusters that may
// hold contacts of each child (Lemma A with two witnesses), and the children that these suffice to dismiss. One
// invocation per parent and child, one workgroup per parent: its eight children walk one list together.
#include "lanes/lanes.glsl"
#include "certified/step.glsl"
#include "certified/witness.glsl"
#define CLUSTER_TEXEL_BINDING 9
#include "certified/cluster.glsl"
#include "certified/dismissal.glsl"

layout(set = 0, binding = 0) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 1) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 2) buffer Counters { uint counters[]; };
// A lower bound of the distance from the centre (bits), and the cluster of the first witness.
layout(set = 0, binding = 3) writeonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 4) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 5) buffer TouchMasks { uint touch_masks[]; };
// Contacts, twice; the cluster of the second witness; the sum of the axes of those that touch, as a packed direction.
layout(set = 0, binding = 6) writeonly buffer Counts { uvec4 counts[]; };
layout(set = 0, binding = 7) writeonly buffer States { uvec4 states[]; };  // kept, list entries, mask words, flags
layout(set = 0, binding = 8) writeonly buffer Requests { uint requests[]; };

const uint kSweeps = 4u;

// The bounds that lane k of the eight has loaded, from entry `list_entry`.
ClusterBounds bounds_of_lane(ClusterBounds mine, uint list_entry, uint k) {
#ifdef LOCKSTEP
  return ClusterBounds(from_lane(mine.centre, k), from_lane(mine.axis, k), from_lane(vec4(mine.rest, 0.0), k).xyz);
#else
  return load_bounds(lists[list_entry]);
#endif
}

// The cluster among the parent's, or among a sample of them, whose known point is nearest to p.
uint witness_near(Cell parent, vec3 p) {
  uint stride = 1u + parent.list_count / kWitnessSample;
  uint best_name = 0u;
  float best = 3e38;
  for (uint entry = 0u; entry < parent.list_count;) {
    uint name = lists[parent.list_begin + entry];
    vec3 v = cluster_texel(name, kClusterPoint).xyz - p;
    best_name = dot(v, v) < best ? name : best_name;
    best = min(best, dot(v, v));
    entry += stride;
    if (entry >= parent.list_count) break;
  }
  return best_name;
}

Witness witness_of(vec3 centre, uint name) {
  vec3 point = cluster_texel(name, kClusterPoint).xyz;
  Witness w = witness_at(name, point - centre);
  [[unroll]] for (uint k = 0; k < 8u; ++k)
    w.to_corner[k] = length(point - centre - step.touch_half_side * corner_sign(k));
  return w;
}

// Result of the first walk over a list.
struct Tally {
  uint contacts, entries;  // clusters, and the number of entries of the child's list
  float clearance;         // no cluster is nearer to the centre
  vec3 axis;               // sum of the axes of the clusters that touch
  bool behind, in_front;   // of all triangles of all clusters that may be the nearest
};

Tally mark(Cell parent, uint child, vec3 centre, Witness front, Witness back, uint base) {
  Tally tally = Tally(0u, 0u, 3e38, vec3(0.0), true, true);
  bool expands = step.lists == kListsExpanded;  // then space is reserved for all triangles of the clusters
  uint word = 0u, touch_word = 0u, last = parent.list_begin + parent.list_count - 1u;
  for (uint entry = 0u; entry < parent.list_count;) {
    uint next = parent.list_begin + entry;
    ClusterBounds mine = load_bounds(lists[min(next + child, last)]);
    for (uint k = 0; k < 8u; ++k) {
      ClusterBounds bounds = bounds_of_lane(mine, min(next + k, last), k);
      vec3 v = vector_to_cluster(centre, bounds);
      float d = length(v);
      vec3 g = v / max(d, 1e-30);
      vec4 along = corners_along(step.touch_half_side * g);
      bool near_front = is_contact(front, d, g), near_back = is_contact(back, d, g);
      bool is_entry = entry + k < parent.list_count;
      bool contact = near_front && near_back && is_entry;
      bool cube_by_front = touches_cube(front, d, along), cube_by_back = touches_cube(back, d, along);
      bool touches = contact && cube_by_front && cube_by_back;
      uint bit = 1u << (entry + k & 31u);
      word |= contact ? bit : 0u;
      touch_word |= touches ? bit : 0u;
      tally.entries += contact ? expands ? uint(bounds.rest.z) : 1u : 0u;
      tally.axis += touches ? bounds.axis.xyz : vec3(0.0);
      tally.clearance = contact ? min(tally.clearance, d) : tally.clearance;
      float side = side_of_cluster(centre, bounds);
      bool is_as_near = d <= front.distance + 6.0 * step.slack, is_behind = side > 0.0, is_in_front = side < 0.0;
      bool may_be_nearest = contact && is_as_near;
      bool keeps_behind = is_behind || !may_be_nearest, keeps_in_front = is_in_front || !may_be_nearest;
      tally.behind = tally.behind && keeps_behind;
      tally.in_front = tally.in_front && keeps_in_front;
    }
    entry += 8u;
    if ((entry & 31u) == 0u || entry >= parent.list_count) {
      uint w = base + (min(entry, parent.list_count) - 1u) / 32u;
      masks[w] = word;
      touch_masks[w] = touch_word;
      tally.contacts += bitCount(word);
      word = 0u;
      touch_word = 0u;
    }
    if (entry >= parent.list_count) break;
  }
  return tally;
}

// The touching cluster that obeys the axis least: cosine of the greatest turn of its spokes from the axis, and the
// vector towards which the axis must move.
struct Offender {
  float cosine;
  vec3 help;
};

Offender worst_offender(Cell parent, uint child, vec3 centre, vec3 axis, uint base) {
  Offender worst = Offender(2.0, axis);
  uint touches = 0u, last = parent.list_begin + parent.list_count - 1u;
  for (uint entry = 0u; entry < parent.list_count;) {
    uint next = parent.list_begin + entry;
    if ((entry & 31u) == 0u) touches = touch_masks[base + entry / 32u];
    ClusterBounds mine = load_bounds(lists[min(next + child, last)]);
    for (uint k = 0; k < 8u; ++k) {
      ClusterBounds bounds = bounds_of_lane(mine, min(next + k, last), k);
      float by_normal = least_cosine_of_normals(axis, bounds);
      vec3 g;
      float by_direction = least_cosine_of_directions(centre, axis, bounds, g);
      float cosine = max(by_normal, by_direction);
      bool is_touching = (touches >> (entry + k & 31u) & 1u) != 0u, is_less = cosine < worst.cosine;
      bool is_worst = is_touching && is_less;
      worst.help = is_worst ? by_direction > by_normal ? g : bounds.axis.xyz : worst.help;
      worst.cosine = is_worst ? cosine : worst.cosine;
    }
    entry += 8u;
    if (entry >= parent.list_count) break;
  }
  return worst;
}

// Dismissal by an axis (axis_test.glsl), for all eight at once: sweeps are made while any of them needs one.
bool is_dismissed(Cell parent, uint child, vec3 centre, vec3 axis, float theta, bool is_open, uint base) {
  float enough = cosine(theta) + kAxisSlack;
  bool dismissed = false;
  for (uint sweep = 0u; sweep < kSweeps; ++sweep) {
    Offender worst = worst_offender(parent, child, centre, axis, base);
    dismissed = dismissed || (is_open && worst.cosine > enough);
    is_open = is_open && !dismissed;
    axis = unit_or_zero(axis + (worst.help - axis) / (float(sweep) + 2.5));
    if (or_of_lanes(is_open ? 1u : 0u) == 0u) break;
  }
  return dismissed;
}

void main() {
  uint item = invocation_index();
  if (item >= 8u * counters[kParents]) return;  // the same for the whole workgroup
  Cell parent = parents[item / 8];
  uint child = item % 8;
  uvec3 coordinates = child_coordinates(parent, child);
  vec3 centre = cell_centre(coordinates);
  Witness front = witness_of(centre, witness_near(parent, centre));
  Witness back = witness_of(centre, witness_near(parent, centre - step.circumradius * front.direction));
  uint base = 8u * parent.word_begin + child * ((parent.list_count + 31u) / 32u);
  Tally tally = mark(parent, child, centre, front, back, base);
  counts[item] = uvec4(tally.contacts, tally.contacts, back.name, packSnorm4x8(vec4(unit_or_zero(tally.axis), 0.0)));
  nearest[item] = uvec2(floatBitsToUint(tally.clearance), front.name);

  bool exists = is_searched(coordinates), is_empty = !exists;
  uint flags = parent.flags & kCellInside;
  bool needs_side = must_decide_side(flags, tally.clearance);
  if (needs_side && step.open_edges == 0u) {
    flags |= tally.behind ? kCellInside : 0u;
    is_empty = is_empty || tally.in_front;
    needs_side = !tally.behind;
  }
  float theta = dismissal_angle(front.distance);
  is_empty = is_dismissed(parent, child, centre, unit_or_zero(tally.axis), theta, !is_empty, base) || is_empty;
  if (exists) COUNT(kVisitedCount, 1u);
  if (child == 0u) COUNT(kClusterTestCount, 8u * parent.list_count);
  states[item] = is_empty ? uvec4(0u) : uvec4(1u, tally.entries, (tally.entries + 31u) / 32u, flags);
  if (!is_empty && needs_side) requests[atomicAdd(counters[kRequests], 1u)] = item;
}
