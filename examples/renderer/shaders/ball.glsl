// What both kinds of balls share: a quad that covers the ball on the screen, through the circle in which the tangents
// from the eye touch it.
#include "camera.glsl"
layout(location = 0) out vec3 world;
layout(location = 1) flat out vec4 ball;
layout(location = 2) flat out vec3 paint;

// From narrow angles to wide ones: blue, green, yellow.
vec3 colour_of(float object_angle) {
  float t = clamp((object_angle - 0.6) / 0.97, 0.0, 1.0);
  vec3 low = mix(vec3(0.20, 0.25, 0.52), vec3(0.13, 0.60, 0.55), min(2.0 * t, 1.0));
  return mix(low, vec3(0.95, 0.88, 0.20), max(2.0 * t - 1.0, 0.0));
}

void place(vec4 centre_and_radius) {
  ball = centre_and_radius;
  // True size on the right, where the balls fill the solid; small on the left, where they show their sheet.
  ball.w = mix(min(ball.w, 0.009), ball.w, smoothstep(-0.1, 0.5, ball.x));
  vec3 to_eye = eye.xyz - ball.xyz;
  float away = length(to_eye);
  vec3 side = normalize(cross(vec3(0.0, 0.0, 1.0), to_eye)), up = normalize(cross(to_eye, side));
  float grown = ball.w * away / sqrt(max(away * away - ball.w * ball.w, 1e-9));
  vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
  world = ball.xyz + grown * (corner.x * side + corner.y * up);
  gl_Position = to_clip * vec4(world, 1.0);
}
