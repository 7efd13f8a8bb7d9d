#version 450
#extension GL_GOOGLE_include_directive : enable
// One instance per sphere, directly from the buffer that the job fills: a quad that covers the sphere on the screen.
#include "camera.glsl"
struct Sphere {  // RecordedSphere of medial_vk/extraction_job.h
  vec4 centre;   // w: radius
  vec4 spoke_a;  // w: object angle
  vec4 spoke_b;  // w: flux
  uvec4 voxel;
};
layout(set = 0, binding = 0) readonly buffer Spheres { Sphere spheres[]; };
layout(location = 0) out vec3 world;
layout(location = 1) flat out vec4 ball;
layout(location = 2) flat out float object_angle;

void main() {
  Sphere s = spheres[gl_InstanceIndex];
  ball = vec4(placement.xyz + placement.w * s.centre.xyz, placement.w * s.centre.w);
  // True size on the right, where the spheres fill the solid; small on the left, where they show their sheet.
  ball.w = mix(min(ball.w, 0.009), ball.w, smoothstep(-0.1, 0.5, ball.x));
  object_angle = s.spoke_a.w;
  vec3 to_eye = eye.xyz - ball.xyz;
  float away = length(to_eye);
  vec3 side = normalize(cross(vec3(0.0, 0.0, 1.0), to_eye)), up = normalize(cross(to_eye, side));
  // Through the circle in which the tangents from the eye touch the sphere.
  float grown = ball.w * away / sqrt(max(away * away - ball.w * ball.w, 1e-9));
  vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
  world = ball.xyz + grown * (corner.x * side + corner.y * up);
  gl_Position = to_clip * vec4(world, 1.0);
}
