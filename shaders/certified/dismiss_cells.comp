#version 450
#extension GL_GOOGLE_include_directive : enable
// Searches, for the children that the first test of mark_contacts.comp leaves open, an axis that all contacts obey
// (axis_test.glsl). The axis is moved towards the contact that violates the condition most (as Badoiu and Clarkson do
// for smallest enclosing balls).
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 11
#include "tree/triangles.glsl"
#include "certified/axis_test.glsl"

layout(set = 0, binding = 1) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) readonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 6) readonly buffer Open { uint open[]; };
layout(set = 0, binding = 7) readonly buffer Axes { vec4 axes[]; };
layout(set = 0, binding = 8) buffer States { uvec4 states[]; };     // kept, list entries, mask words, flags
layout(set = 0, binding = 9) writeonly buffer Requests { uint requests[]; };  // kept children whose side is not known
layout(set = 0, binding = 10) readonly buffer Counts { uvec4 counts[]; };  // y: contacts that touch

const uint kNormalSweeps = 6;     // with normals alone: no distances, and enough for most cells
const uint kDirectionSweeps = 3;  // with directions too; pairs dismiss what is left below the finest voxel
// lavapipe ends the loops of an invocation after 65,535 iterations in all, counted for up to 16 neighbours together. A
// sweep takes at most one iteration per entry of the list (a word without contacts takes one for all its entries). So a
// cell that may make s sweeps takes at most kLoopBudget / s for each. Of the up to 6 sweeps by normals, the k-th is
// made only by cells with s >= k; then all invocations meet. The same holds for the sweeps by directions, of which
// there are 3. The sum is less than kLoopBudget (1 + 1/2 + ... + 1/6 + 1 + 1/2 + 1/3), or 44,600, with the sweeps
// themselves. Cells with lists too long for a sweep are kept unproved.
const uint kLoopBudget = 10400;

float theta, cos_theta;
vec3 centre, to_nearest;

// Amount by which contact t violates axis a by its normal alone (cosine; below 0: it obeys).
float normal_violation(uint t, vec3 axis, out vec3 help) {
  vec4 normal = triangle_texel(4 * t + 3);
  help = normal.xyz;
  return normal.w > 0.5 ? cos_theta - dot(normal.xyz, axis) : 4.0;
}

// The same by its normal or its direction, and the vector towards which the axis must move.
float violation(uint t, vec3 axis, out vec3 help) {
  TriangleTexels texels = load_triangle(t);
  bool trusted = texels.normal.w > 0.5;
  float by_normal = trusted ? cos_theta - dot(texels.normal.xyz, axis) : 4.0;
  vec3 v = vector_to_triangle(centre, texels);
  float d = length(v), rho = step.circumradius;
  vec3 g = unit_or_zero(v);
  float spread = d > rho ? arcsine(min(1.0, (rho + 2.0 * step.slack) / d)) + tilt_of(texels) : 4.0;
  float by_direction = spread < theta ? cosine(theta - spread) + kAxisSlack - dot(g, axis) : 4.0;
  help = by_direction < by_normal ? g : texels.normal.xyz;
  return min(by_normal, by_direction);
}

// One sweep over the contacts, an iteration for each contact and for each word without any: the worst violation, its
// contact, and the vector towards which the axis must move.
float worst_violation(Cell parent, uint word_base, uint word_count, vec3 axis, bool directions, out vec3 towards,
                      out uint offender) {
  float worst = -2.0;
  towards = axis;
  offender = 0u;
  uint w = 0u, word = masks[word_base];
  while (w < word_count) {
    bool counts = word != 0u;
    uint bit = counts ? uint(findLSB(word)) : 0u;
    uint t = lists[parent.list_begin + 32u * w + bit];
    vec3 help;
    float v;
    if (directions)
      v = violation(t, axis, help);
    else
      v = normal_violation(t, axis, help);
    bool is_worse = counts && v > worst;
    towards = is_worse ? help : towards;
    offender = is_worse ? t : offender;
    worst = is_worse ? v : worst;
    word &= word - 1u;
    bool next = word == 0u;
    w += next ? 1u : 0u;
    word = next && w < word_count ? masks[word_base + w] : word;
    if (w >= word_count) break;
  }
  return worst;
}

// `tests`: number of distances evaluated.
bool provably_empty(Cell parent, uint item, uint word_base, uint word_count, inout uint tests) {
  uint sweeps = kLoopBudget / parent.list_count;
  vec3 axis = unit_or_zero(axes[item].xyz), towards;
  uint sweep = 0, offender, touching = counts[item].y;
  Obedience last = obedience_of(nearest[item].y, centre, theta);
  for (; sweep < min(kNormalSweeps, sweeps); ++sweep) {
    float worst = worst_violation(parent, word_base, word_count, axis, false, towards, offender);
    if (worst < 0.0) return true;
    if (worst > 3.0) break;  // an untrusted normal
    Obedience next = obedience_of(offender, centre, theta);
    if (incompatible(last, next)) return false;
    last = next;
    axis = unit_or_zero(axis + (towards - axis) / (float(sweep) + 2.5));
  }
  // Directions gather around that of the nearest contact: at a reflex edge or vertex they agree, and normals do not.
  if (dot(to_nearest, to_nearest) > step.circumradius * step.circumradius) axis = unit_or_zero(to_nearest);
  for (uint extra = 0; extra < min(kDirectionSweeps, sweeps - min(sweep, sweeps)); ++extra) {
    float worst = worst_violation(parent, word_base, word_count, axis, true, towards, offender);
    tests += touching;
    if (worst < 0.0) return true;
    if (worst > 3.0) return false;  // a contact without a usable direction
    Obedience next = obedience_of(offender, centre, theta);
    if (incompatible(last, next)) return false;
    last = next;
    axis = unit_or_zero(axis + (towards - axis) / (float(extra) + 2.5));
  }
  return false;
}

void main() {
  uint index = invocation_index();
  if (index >= counters[kOpen]) return;
  uint item = open[index];
  Cell parent = parents[item / 8];
  centre = cell_centre(child_coordinates(parent, item % 8));
  to_nearest = vector_to_triangle(centre, load_triangle(nearest[item].y));
  float nearest_distance = length(to_nearest);
  theta = dismissal_angle(nearest_distance);
  cos_theta = cosine(theta) + kAxisSlack;
  uint word_count = (parent.list_count + 31u) / 32u;
  uint tests = 0u;
  bool is_empty = provably_empty(parent, item, 8u * parent.word_begin + (item % 8) * word_count, word_count, tests);
  COUNT_TESTS(tests);
  if (is_empty)
    states[item] = uvec4(0);
  else if (must_decide_side(states[item].w, nearest_distance))
    requests[atomicAdd(counters[kRequests], 1u)] = item;  // in any order: every result is written to its own state
}
