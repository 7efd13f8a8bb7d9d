// The side of the boundary on which a whole cell lies that does not meet it. Include closure.glsl before.
//
// On a closed mesh the winding number is constant on the ball. On an open mesh it changes no faster than the bound of
// closure.glsl. For meshes with too many open edges for that bound, the winding number is only known to be harmonic on
// the ball, and Harnack's inequality applies: a positive harmonic function on a ball of radius R around c is, within r
// of c, at most R (R + r) / (R - r)^2 times its value at c. It is applied to w + kSpill (outside) and 1 + kSpill - w
// (inside), which are positive if winding numbers stay in [-kSpill, 1 + kSpill]: an assumption about such meshes
// (docs/theory.md).
#ifndef MEDIAL_VK_CELL_SIDE_GLSL
#define MEDIAL_VK_CELL_SIDE_GLSL

const uint kSideUnknown = 0u, kSideInside = 1u, kSideOutside = 2u;
const float kSpill = 0.05;

uint side_by_harnack(vec3 centre, float radius, float clearance) {
  float gap = clearance - radius;
  if (gap <= 0.0) return kSideUnknown;
  float harnack = clearance * (clearance + radius) / (gap * gap);
  for (float tolerance = 0.2; tolerance > 0.01; tolerance *= 0.2) {
    // Not even a winding number of 0 or 1 could decide the side.
    if ((tolerance + kSpill) * harnack >= 0.5 + kSpill) continue;
    Winding w = rough_winding_number(centre, tolerance);
    if (!w.complete) return kSideUnknown;
    float above = w.number + w.bound + kSpill, below = 1.0 + kSpill + w.bound - w.number;
    if (above > 0.0 && above * harnack < 0.5 + kSpill) return kSideOutside;
    if (below > 0.0 && below * harnack < 0.5 + kSpill) return kSideInside;
  }
  return kSideUnknown;
}

// The change of the winding number within `radius` of the point at which the closure was evaluated: the change `along`
// its gradient, plus the change of that gradient; or the greatest change that is possible anywhere. The gradient is
// accurate to a part of the slope, and to its change over the slack of the points (docs/theory.md, "Rounding").
float change_within(float radius, float along, Closure closure) {
  float by_gradient = along + radius * (2e-3 * closure.slope + (radius + 2.0 * step.slack) * closure.bend);
  return min(radius * closure.slope, by_gradient);
}

// `clearance`: a lower bound of the distance from the centre to the boundary. Outside is decided for the cell; inside
// is decided for everything within epsilon of its ball, where its lines may end.
uint side_of_cell(vec3 centre, float clearance) {
  float radius = step.circumradius + step.epsilon;
  if (clearance <= step.circumradius) return kSideUnknown;
  if (kIsOpen && step.open_edges > kMostOpenEdges) return side_by_harnack(centre, radius, clearance);
  bool tests_ball = clearance > radius;
  vec3 direction = direction_out(centre);
  Closure closure = closure_at(centre, tests_ball ? radius : step.circumradius, direction);
  Winding w = accurate_winding_number(centre, direction, closure);
  if (!w.complete) return kSideUnknown;
  vec3 g = abs(closure.gradient);
  float in_cell = change_within(step.circumradius, step.half_side * (g.x + g.y + g.z), closure);
  float in_ball = change_within(radius, radius * length(g), closure);
  bool outside = w.number + w.bound + in_cell < 0.5, inside = tests_ball && w.number - w.bound - in_ball >= 0.5;
  return outside ? kSideOutside : inside ? kSideInside : kSideUnknown;
}

#endif
