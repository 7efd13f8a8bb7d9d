#version 450
#extension GL_GOOGLE_include_directive : enable
#include "panel.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 seen_normal;

void main() {
  seen_normal = turn(normal);
  vec3 seen = turn(position);
  float w = panel.layer.w - seen.z;
  vec2 at = vec2(panel.right.w, panel.up.w) * w + panel.towards.w * vec2(seen.x, -seen.y);
  // Depth is linear in nearness, 1 / w, so that it is linear across a triangle.
  gl_Position = vec4(2.0 * at / panel.layer.xy - w, panel.depth.y * (1.0 - panel.depth.x * w), w);
}
