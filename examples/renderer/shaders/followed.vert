#version 450
#extension GL_GOOGLE_include_directive : enable
// One instance per ball, directly from the buffers that the follower job fills. A ball keeps the colour of its object
// angle at rest, so that the eye can follow it, while it is medial; otherwise it is red.
#include "ball.glsl"
layout(set = 0, binding = 0) readonly buffer Balls { vec4 balls[]; };      // RecordedBall: w is the radius
layout(set = 0, binding = 1) readonly buffer States { uint states[]; };    // FollowState
layout(set = 0, binding = 2) readonly buffer Angles { float angles[]; };   // at rest

void main() {
  paint = states[gl_InstanceIndex] == 0u ? colour_of(angles[gl_InstanceIndex]) : vec3(0.80, 0.25, 0.12);
  place(balls[gl_InstanceIndex]);  // a lost ball has the radius 0: nothing of it is seen
}
