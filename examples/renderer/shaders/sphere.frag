#version 450
#extension GL_GOOGLE_include_directive : enable
#include "camera.glsl"
layout(location = 0) in vec3 world;
layout(location = 1) flat in vec4 ball;
layout(location = 2) flat in vec3 paint;
layout(location = 0) out vec4 colour;

void main() {
  vec3 ray = normalize(world - eye.xyz), from = eye.xyz - ball.xyz;
  float b = dot(from, ray);
  vec3 across = from - b * ray;  // from the centre to the ray, a form that keeps the digits of small spheres
  float root = ball.w * ball.w - dot(across, across);
  if (root < 0.0) discard;
  vec3 hit = eye.xyz + (-b - sqrt(root)) * ray;
  vec4 clip = to_clip * vec4(hit, 1.0);
  gl_FragDepth = clip.z / clip.w;
  colour = vec4(shade(paint, (hit - ball.xyz) / ball.w, -ray), 1.0);
}
