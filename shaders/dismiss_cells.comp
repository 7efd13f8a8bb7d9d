#version 450
#extension GL_GOOGLE_include_directive : enable
// Certified dismissal (docs/theory.md): a child is dropped if some axis a has, for every contact t, either
//   the trusted outward normal of t within theta of a, or
//   D_t > rho and angle(g_t, a) + asin(rho / D_t) < theta,
// because then every spoke of every medial point in the cell lies within theta of a. The axis is sought by moving it
// towards the contact that violates most (as Badoiu and Clarkson do for smallest enclosing balls).
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 10
#include "triangles.glsl"

layout(set = 0, binding = 1) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) readonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 6) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 7) readonly buffer Axes { vec4 axes[]; };
layout(set = 0, binding = 8) writeonly buffer States { uvec4 states[]; };  // kept, list entries, mask words, flags
layout(set = 0, binding = 9) writeonly buffer Asked { uint asked[]; };       // kept children that do not know their side

const uint kNormalSweeps = 6;     // with normals alone: no distances, and enough for most
const uint kDirectionSweeps = 3;  // with directions too; two more for every level below the finest voxel
// lavapipe ends the loops of an invocation after 65,535 iterations in all, counted for up to 16 neighbours together.
// Children of one parent walk masks of one list: a sweep takes at most one iteration per entry and, as each may skip
// empty words at another time, eight per word. Cells with lists too long for a sweep are kept unproved.
const uint kLoopBudget = 30000;

float theta, cos_theta;
vec3 centre, to_nearest;

// How far contact t is from obeying axis a by its normal alone (cosine; below 0: it obeys).
float normal_violation(uint t, vec3 axis, out vec3 help) {
  vec4 normal = triangle_texel(4 * t + 3);
  help = normal.xyz;
  return normal.w > 0.5 ? cos_theta - dot(normal.xyz, axis) : 4.0;
}

// The same by its normal or its direction, and the vector that would help.
float violation(uint t, vec3 axis, out vec3 help, inout bool distrust) {
  TriangleTexels texels = load_triangle(t);
  bool trusted = texels.normal.w > 0.5;
  float by_normal = trusted ? cos_theta - dot(texels.normal.xyz, axis) : 4.0;
  vec3 v = vector_to_triangle(centre, texels);
  float d = length(v), rho = step.circumradius;
  vec3 g = unit_or_zero(v);
  distrust = distrust || !trusted;
  float spread = d > rho ? asin(min(1.0, (rho + 2.0 * step.slack) / d)) + tilt_of(texels) : 4.0;
  float by_direction = spread < theta ? cos(theta - spread) + 1e-6 - dot(g, axis) : 4.0;
  help = by_direction < by_normal ? g : texels.normal.xyz;
  return min(by_normal, by_direction);
}

// One sweep over the contacts: the worst violation, the contact that makes it, and the vector that would help it.
float worst_violation(Cell parent, uint word_base, uint word_count, vec3 axis, bool directions, out vec3 towards,
                      out uint offender, inout bool distrust) {
  float worst = -2.0;
  towards = axis;
  offender = 0u;
  uint w = 0, word = masks[word_base];
  for (;;) {
    while (word == 0u && ++w < word_count) word = masks[word_base + w];
    if (word == 0u) return worst;
    uint t = lists[parent.list_begin + 32u * w + uint(findLSB(word))];
    word &= word - 1u;
    vec3 help;
    float v;
    if (directions)
      v = violation(t, axis, help, distrust);
    else
      v = normal_violation(t, axis, help);
    towards = v > worst ? help : towards;
    offender = v > worst ? t : offender;
    worst = max(worst, v);
  }
}

// The two cones of axes that a contact obeys: by its normal and by its direction (half-angle below 0: none).
struct Obedience {
  vec3 normal, direction;
  float by_normal, by_direction;
};

Obedience obedience_of(uint t) {
  TriangleTexels texels = load_triangle(t);
  vec3 v = vector_to_triangle(centre, texels);
  vec3 g = unit_or_zero(v);
  float d = length(v), rho = step.circumradius;
  return Obedience(texels.normal.xyz, g, texels.normal.w > 0.5 ? theta : -8.0,
                   d > rho ? theta - asin(min(1.0, rho / d)) : -8.0);
}

bool cones_meet(vec3 a, float half_a, vec3 b, float half_b) {
  float sum = half_a + half_b;
  return half_a > 0.0 && half_b > 0.0 && (sum >= 3.1 || dot(a, b) > cos(sum));
}

// No axis obeys both contacts: more sweeps are useless.
bool incompatible(Obedience a, Obedience b) {
  return !cones_meet(a.normal, a.by_normal, b.normal, b.by_normal) &&
         !cones_meet(a.normal, a.by_normal, b.direction, b.by_direction) &&
         !cones_meet(a.direction, a.by_direction, b.normal, b.by_normal) &&
         !cones_meet(a.direction, a.by_direction, b.direction, b.by_direction);
}

bool provably_empty(Cell parent, uint item, uint word_base, uint word_count, out bool distrust) {
  distrust = false;
  uint sweeps = kLoopBudget / (parent.list_count + 8u * word_count + 8u);
  vec3 axis = unit_or_zero(axes[item].xyz), towards;
  uint sweep = 0, offender;
  Obedience last = obedience_of(nearest[item].y);
  for (; sweep < min(kNormalSweeps, sweeps); ++sweep) {
    float worst = worst_violation(parent, word_base, word_count, axis, false, towards, offender, distrust);
    if (worst < 0.0) return true;
    if (worst > 3.0) break;  // an untrusted normal
    Obedience next = obedience_of(offender);
    if (incompatible(last, next)) return false;
    last = next;
    axis = unit_or_zero(axis + (towards - axis) / (float(sweep) + 2.5));
  }
  // Directions gather around that of the nearest contact: at a reflex edge or vertex they agree, and normals do not.
  if (dot(to_nearest, to_nearest) > step.circumradius * step.circumradius) axis = unit_or_zero(to_nearest);
  for (uint extra = 0; extra < min(kDirectionSweeps + 2u * step.depth, sweeps - min(sweep, sweeps)); ++extra) {
    float worst = worst_violation(parent, word_base, word_count, axis, true, towards, offender, distrust);
    if (worst < 0.0) return true;
    if (worst > 3.0) return false;  // a contact without any usable direction
    Obedience next = obedience_of(offender);
    if (incompatible(last, next)) return false;
    last = next;
    axis = unit_or_zero(axis + (towards - axis) / (float(extra) + 2.5));
  }
  return false;
}

void main() {
  uint item = invocation_index();
  if (item >= 8u * counters[kParents]) return;
  Cell parent = parents[item / 8];
  uvec3 coordinates = child_coordinates(parent, item % 8);
  states[item] = uvec4(0);
  if (step.depth == 0u && any(greaterThanEqual(coordinates * step.voxels_per_cell,
                                               uvec3(step.grid_x, step.grid_y, step.grid_z))))
    return;
  atomicAdd(counters[kStatistics + kStatisticsPerLevel * step.level], 1u);
  centre = cell_centre(coordinates);
  to_nearest = vector_to_triangle(centre, load_triangle(nearest[item].y));
  float nearest_distance = length(to_nearest);
  // Where the radius may pass its threshold, smaller angles count too.
  bool deep = nearest_distance + step.circumradius + step.slack >= step.radius;
  theta = deep ? min(step.deep_angle, step.angle) : step.angle;
  // Rounding: directions are wrong by up to about slack / D; a cosine by 1e-6.
  theta -= 1e-5;
  cos_theta = cos(theta) + 1e-6;
  uint word_count = (parent.list_count + 31u) / 32u;
  bool distrust;
  if (provably_empty(parent, item, 8u * parent.word_begin + (item % 8) * word_count, word_count, distrust))
    return;
  uint flags = parent.flags & kCellInside;
  if (distrust && nearest_distance <= step.circumradius) flags |= kCellUntrusted;
  // Their order does not matter: every answer goes to its own state.
  if ((flags & kCellInside) == 0u && nearest_distance > step.circumradius + step.epsilon + step.slack)
    asked[atomicAdd(counters[kAsked], 1u)] = item;
  states[item] = uvec4(1u, counts[item], (counts[item] + 31u) / 32u, flags);
}
