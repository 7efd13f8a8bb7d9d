// What all tests of dismissal share. Include "step.glsl" before.
#ifndef MEDIAL_VK_DISMISSAL_GLSL
#define MEDIAL_VK_DISMISSAL_GLSL
#include "lanes/angles.glsl"

// The threshold of the object angle; where the radius may pass its own, smaller angles count too. Less rounding:
// directions are wrong by up to about slack / D, and a cosine by kAxisSlack. A distance that is too large is safe.
float dismissal_angle(float nearest_distance) {
  bool deep = nearest_distance + step.circumradius + step.slack >= step.radius;
  return (deep ? min(step.deep_angle, step.angle) : step.angle) - 1e-5;
}
const float kAxisSlack = 1e-6;

// Whether a kept cell must ask on which side of the boundary it lies: its ball does not meet that, and no ancestor
// knew. Inside must hold of what is within epsilon as well. On an open mesh a cell may be outside where that is not known.
bool must_ask_side(uint flags, float nearest_distance) {
  float reach = step.circumradius + (step.open_edges == 0u ? step.epsilon : 0.0) + step.slack;
  return (flags & kCellInside) == 0u && nearest_distance > reach;
}

#endif
