// On which side of the boundary a whole ball lies that does not meet it. Include winding.glsl and closure.glsl before.
//
// On a closed mesh the winding number is constant on the ball. On an open mesh it changes no faster than closure.glsl
// says. Of meshes with too many open edges for that, only this is known: the winding number is harmonic on the ball,
// and Harnack's inequality bounds it: a positive harmonic function on a ball of radius R around c is, within r of c, at
// most R (R + r) / (R - r)^2 times its value at c. It is used for w + kSpill (outside) and 1 + kSpill - w (inside),
// which are positive if winding numbers stay in [-kSpill, 1 + kSpill]: an assumption about such meshes (docs/theory.md).
#ifndef MEDIAL_VK_CELL_SIDE_GLSL
#define MEDIAL_VK_CELL_SIDE_GLSL

const uint kSideUnknown = 0u, kSideInside = 1u, kSideOutside = 2u;
const float kSpill = 0.05;

uint side_by_harnack(vec3 centre, float radius, float clearance) {
  float gap = clearance - radius;
  float harnack = clearance * (clearance + radius) / (gap * gap);
  for (float tolerance = 0.2; tolerance > 0.01; tolerance *= 0.2) {
    // Not even a winding number of 0 or 1 could decide.
    if ((tolerance + kSpill) * harnack >= 0.5 + kSpill) continue;
    Winding w = winding_number(centre, tolerance);
    if (!w.complete) return kSideUnknown;
    float above = w.number + w.bound + kSpill, below = 1.0 + kSpill + w.bound - w.number;
    if (above > 0.0 && above * harnack < 0.5 + kSpill) return kSideOutside;
    if (below > 0.0 && below * harnack < 0.5 + kSpill) return kSideInside;
  }
  return kSideUnknown;
}

// `clearance`: a lower bound of the distance from the centre to the boundary.
uint side_of_ball(vec3 centre, float radius, float clearance) {
  if (clearance <= radius) return kSideUnknown;
  if (step.open_edges > kMostOpenEdges) return side_by_harnack(centre, radius, clearance);
  Closure closure = closure_at(centre, radius);
  Winding w = exact_winding_number(winding_number(centre, kRoughTolerance), closure);
  if (!w.complete) return kSideUnknown;
  float change = w.bound + radius * closure.slope;
  return w.number - change >= 0.5 ? kSideInside : w.number + change < 0.5 ? kSideOutside : kSideUnknown;
}

#endif
