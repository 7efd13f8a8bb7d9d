// Lemma M (docs/theory.md): whether linear conditions on a point that has spokes to two carriers hold together anywhere
// in the box. The eight lanes of a cell share the conditions of one pair, four of them those of one carrier. Include
// after "carrier_pairs.glsl".
#ifndef MEDIAL_VK_JOINT_CONDITIONS_GLSL
#define MEDIAL_VK_JOINT_CONDITIONS_GLSL

const uint kJointSteps = 12u;
const float kOverstep = 1.3;     // of a step to the plane of the condition that is violated most
const float kWidestAxis = 0.7;   // half-angle of a cap whose axis bounds distances
const float kWidestTurn = 1.5;   // radians, below a right angle
const float kLeastSlope = 1e-6;  // of a condition

// A condition holds for the points x = m - centre with bound.xyz . x + bound.w >= 0. Errors are added to w.
const vec4 kNoCondition = vec4(0.0, 0.0, 0.0, 1.0);

vec4 raised(vec4 bound, float by) { return bound + vec4(0.0, 0.0, 0.0, by); }
vec4 half_space(vec3 direction, vec3 start) { return vec4(direction, -dot(direction, start)); }
vec4 scaled(vec4 condition) { return condition / max(length(condition.xyz), kLeastSlope); }

// Linear bounds of D(m) if m has a spoke to a carrier: `lower`, and `lower` times `factor` plus `bend`.
struct Bounds {
  vec4 lower;
  float factor, bend, error;
};

vec4 upper_of(Bounds b) { return raised(b.factor * b.lower, b.bend + b.error); }

// By the axis of its cap, if that is perpendicular to the carrier, or by the tangent at the nearest point. `start`: a
// corner of it, from the centre; `error`: of a half-space that begins there.
Bounds bounds_of(Carrier c, vec3 start, float error, Box box) {
  vec2 of_tangent = error_of(c, box);
  bool has_axis = c.spokes.w < kWidestAxis && c.spokes.xyz != c.nearest.xyz;
  Bounds b = Bounds(vec4(-c.nearest.xyz, c.nearest.w), 1.0, of_tangent.y, of_tangent.x);
  if (has_axis) b = Bounds(half_space(-c.spokes.xyz, start), 1.0 / cosine(c.spokes.w), 0.0, error);
  return b;
}

Bounds of_opposite_lane(Bounds mine) {
  vec4 rest = opposite_lane(vec4(mine.factor, mine.bend, mine.error, 0.0));
  return Bounds(opposite_lane(mine.lower), rest.x, rest.y, rest.z);
}

// The conditions of a carrier, two for each of its lanes: that it is no farther than the other; that the foot is inside
// a face or an edge; that spokes to an edge lie between the normals beside it; that its spoke is far enough from those
// of the other. And the bounds of both.
void conditions_of(Carrier mine, Carrier other, float theta, Box box, out Bounds bounds, out Bounds others,
                   out vec4 first, out vec4 second) {
  uint i = gl_LocalInvocationID.x % 4u, kind = mine.name % 8u;
  bool is_corner = kind >= kFirstCorner && kind < kFront, is_edge = kind >= kFirstEdge && kind < kFirstCorner;
  bool is_one_sided = !is_two_sided(mine.name), is_face = kind == kFace && is_one_sided, is_between = is_edge && is_one_sided;
  uint k = is_corner ? kind - kFirstCorner : is_edge ? kind - kFirstEdge : max(i, 1u) - 1u;
  TriangleTexels texels = load_triangle(mine.name / 8u);
  vec3 p = corner_of(texels, k) - box.centre, e = corner_of(texels, k == 2u ? 0u : k + 1u) - box.centre - p;
  vec3 u = unit_or_zero(e), n, beside;
  float reach = length(p) + length(texels.ab.xyz) + length(texels.ac.xyz) + box.circumradius;
  float error = 4.0 * near_slack + 2.0 * (tilt_of(texels) + kAngleSlack) * reach;
  bounds = bounds_of(mine, p, error, box);
  others = of_opposite_lane(bounds);
  normals_of(is_between ? mine.name : 8u * (mine.name / 8u), n, beside);
  vec3 inward = cross(n, u);
  vec3 direction = is_face ? inward : i == 1u ? u : i == 2u ? -u : -inward;
  first = raised(half_space(direction, is_edge && i == 2u ? p + e : p), error);
  second = kNoCondition;
  float least_turn = max(2.0 * (theta - kAngleSlack) - other.spokes.w, 0.0);
  if (i == 0u) {
    first = raised(upper_of(bounds) - others.lower, others.error);
    vec3 across = is_edge ? other.spokes.xyz - dot(other.spokes.xyz, u) * u : other.spokes.xyz;
    if ((is_edge || is_corner) && least_turn < kWidestTurn)
      second = raised(half_space(across, p) + (cosine(least_turn) + kCosineSlack) * upper_of(others), error);
  } else if (!is_face && !is_between) {
    first = kNoCondition;
  } else if (is_between && i == 1u) {
    second = raised(half_space(cross(beside, u), p), error);
  }
}

// False: no point of the box satisfies all conditions of the pair, which is the same in all lanes. `rival`: the carrier
// of this lane in row 0. `point`: from the centre; w: 1 if it satisfies all of them. `across`: the normal of the sheet
// there, if its length is not 0.
bool can_be_joint(Carrier a, Carrier b, Carrier rival, float theta, Box box, out vec4 point, out vec3 across) {
  uint lane = gl_LocalInvocationID.x;
  bool is_first = lane < kLanes / 2u;
  Carrier mine = a, other = b;
  if (!is_first) {
    mine = b;
    other = a;
  }
  Bounds bounds, others;
  vec4 all[4];
  conditions_of(mine, other, theta, box, bounds, others, all[2], all[3]);
  across = sum_of_lanes(vec4(lane == 0u ? bounds.lower.xyz - others.lower.xyz : vec3(0.0), 0.0)).xyz;
  bool is_third = lane < min(kPairRivals, kept_count) && rival.name != a.name && rival.name != b.name;
  vec2 error = error_of(rival, box);
  vec4 farthest = vec4(-rival.nearest.xyz, rival.nearest.w + error.x + error.y);
  all[0] = is_third ? raised(farthest - bounds.lower, bounds.error) : kNoCondition;
  all[1] = is_third ? raised(farthest - others.lower, others.error) : kNoCondition;
  [[unroll]] for (uint k = 0u; k < 4u; ++k) all[k] = scaled(all[k]);
  vec4 sum = vec4(0.0);
  bool is_empty = false;
  point = vec4(0.0);
  for (uint steps = 0u; steps < kJointSteps;) {
    vec4 worst = kNoCondition;
    float least = 3e38;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
      float excess = dot(all[k].xyz, point.xyz) + all[k].w;
      bool is_worse = excess < least;
      worst = is_worse ? all[k] : worst;
      least = is_worse ? excess : least;
    }
    float least_of_all = least_of_lanes(least);
    bool is_worst = lane == first_lane_with(least == least_of_all);
    vec4 next = sum_of_lanes(is_worst ? max(0.0, -least) * worst : vec4(0.0));
    sum += next;
    is_empty = sum.w + dot(box.half_sides, abs(sum.xyz)) < 0.0;
    bool satisfies = least_of_all >= 0.0;
    point = vec4(clamp(point.xyz + kOverstep * next.xyz, -box.half_sides, box.half_sides), satisfies ? 1.0 : 0.0);
    if (is_empty || satisfies || ++steps >= kJointSteps) break;
  }
  return !is_empty;
}

#endif
