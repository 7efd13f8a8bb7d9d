// Definitions that all tests of dismissal share. Include "step.glsl" before.
#ifndef MEDIAL_VK_DISMISSAL_GLSL
#define MEDIAL_VK_DISMISSAL_GLSL
#include "lanes/angles.glsl"

// The threshold of the object angle; if the radius may exceed its own threshold, smaller angles count too. It is
// reduced by the rounding: directions have an error of up to about slack / D, and a cosine one of kAxisSlack. A
// distance that is too large is safe.
float dismissal_angle(float nearest_distance) {
  bool deep = nearest_distance + step.circumradius + step.slack >= step.radius;
  return (deep ? min(step.deep_angle, step.angle) : step.angle) - 1e-5;
}
const float kAxisSlack = 1e-6;

// True if the side of the boundary must be determined for a kept cell: its ball does not meet the boundary, and no
// ancestor knew its side. The side `inside` must also hold of everything within epsilon. On an open mesh a cell may be
// outside although that is not known.
bool must_decide_side(uint flags, float nearest_distance) {
  float reach = step.circumradius + (step.open_edges == 0u ? step.epsilon : 0.0) + step.slack;
  return (flags & kCellInside) == 0u && nearest_distance > reach;
}

#endif
