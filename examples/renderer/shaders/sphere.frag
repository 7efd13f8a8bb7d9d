#version 450
#extension GL_GOOGLE_include_directive : enable
#include "camera.glsl"
layout(location = 0) in vec3 world;
layout(location = 1) flat in vec4 ball;
layout(location = 2) flat in float object_angle;
layout(location = 0) out vec4 colour;

// From narrow angles to wide ones: blue, green, yellow.
vec3 colour_of(float angle) {
  float t = clamp((angle - 0.6) / 0.97, 0.0, 1.0);
  vec3 low = mix(vec3(0.20, 0.25, 0.52), vec3(0.13, 0.60, 0.55), min(2.0 * t, 1.0));
  return mix(low, vec3(0.95, 0.88, 0.20), max(2.0 * t - 1.0, 0.0));
}

void main() {
  vec3 ray = normalize(world - eye.xyz), from = eye.xyz - ball.xyz;
  float b = dot(from, ray);
  vec3 across = from - b * ray;  // from the centre to the ray, a form that keeps the digits of small spheres
  float root = ball.w * ball.w - dot(across, across);
  if (root < 0.0) discard;
  vec3 hit = eye.xyz + (-b - sqrt(root)) * ray;
  vec4 clip = to_clip * vec4(hit, 1.0);
  gl_FragDepth = clip.z / clip.w;
  colour = vec4(shade(colour_of(object_angle), (hit - ball.xyz) / ball.w, -ray), 1.0);
}
