#version 450
#extension GL_GOOGLE_include_directive : enable
#include "panel.glsl"
#include "marks.glsl"
layout(location = 0) out vec2 at;            // samples
layout(location = 1) flat out vec4 ball;     // centre from the eye, y down and z away; radius
layout(location = 2) flat out float value;

// The interval in which the shadow of the ball meets a line at a distance of 1 from the eye: the tangents in a plane
// through the eye.
vec2 shadow(float across, float away, float radius) {
  float square = away * away - radius * radius;
  float root = radius * sqrt(max(across * across + square, 0.0));
  return vec2(across * away - root, across * away + root) / square;
}

void main() {
  Mark m = mark();
  vec3 seen = turn(m.centre.xyz);
  ball = vec4(seen.x, -seen.y, panel.layer.w - seen.z, m.centre.w);
  value = m.normal.w;
  at = vec2(0.0);
  gl_Position = vec4(2.0, 2.0, 0.5, 1.0);  // outside
  if (ball.z <= 1.01 * ball.w) return;
  vec2 x = shadow(ball.x, ball.z, ball.w), y = shadow(ball.y, ball.z, ball.w);
  vec2 offset = vec2(panel.right.w, panel.up.w), first = panel.layer.z * vec2(panel.what.z, panel.place.x) - panel.place.z;
  vec2 least = max(offset + panel.towards.w * vec2(x.x, y.x), panel.layer.z * m.seen.xy - first);
  vec2 greatest = min(offset + panel.towards.w * vec2(x.y, y.y), panel.layer.z * m.seen.zw - first);
  at = mix(least, max(least, greatest), 0.5 * corner() + 0.5);
  gl_Position = clip_of(at);
}
