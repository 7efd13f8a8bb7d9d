#version 450
#extension GL_GOOGLE_include_directive : enable
#include "panel.glsl"
layout(location = 0) in vec2 from_centre;
layout(location = 1) flat in vec4 normal_value;
layout(location = 2) flat in vec4 shape;
layout(location = 3) flat in vec2 centre_nearness;
layout(location = 0) out vec4 seen;  // x and y of the normal, position in the palette, distance from the centre

void main() {
  float across = dot(from_centre, shape.xy);
  float along = from_centre.x * shape.y - from_centre.y * shape.x;
  float rim = length(vec2(across / shape.z, along)) / shape.w;
  if (rim > 1.0) discard;
  // The side towards which the normal leans is farther from the viewer.
  float tangent = sqrt(1.0 - shape.z * shape.z) / shape.z;
  gl_FragDepth = depth_of(centre_nearness.x - across * tangent * centre_nearness.y);
  seen = vec4(normal_value.xyw, rim);
}
