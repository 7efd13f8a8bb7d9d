#version 450
#extension GL_GOOGLE_include_directive : enable
#include "camera.glsl"
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 world_normal;
layout(location = 0) out vec4 colour;

void main() {
  vec3 to_eye = normalize(eye.xyz - world), n = normalize(world_normal);
  float grazing = 1.0 - abs(dot(n, to_eye));
  colour = vec4(shade(vec3(0.30, 0.42, 0.58), n, to_eye), mix(0.06, 0.80, grazing * grazing));
}
