#version 450
#extension GL_GOOGLE_include_directive : enable
#include "panel.glsl"
#include "marks.glsl"
layout(location = 0) out vec2 from_centre;          // samples, y down
layout(location = 1) flat out vec4 normal_value;    // normal in view space, towards the viewer; position in the palette
layout(location = 2) flat out vec4 shape;           // direction of the tilt, flattening, radius
layout(location = 3) flat out vec2 centre_nearness;  // at the centre, and its decrease over the length of a sample

void main() {
  const float least_flattening = 0.35;  // a disc that is seen from its rim does not vanish
  Mark m = mark();
  vec3 seen = turn(m.centre.xyz);
  float nearness = 1.0 / (panel.layer.w - seen.z);
  vec2 centre = vec2(panel.right.w, panel.up.w) + panel.towards.w * nearness * vec2(seen.x, -seen.y);
  float radius = max(m.centre.w * panel.towards.w * nearness, panel.depth.z);
  vec3 normal = turn(m.normal.xyz);
  if (normal.z < 0.0) normal = -normal;
  float tilt = length(normal.xy);
  from_centre = corner() * radius;
  normal_value = vec4(normal, m.normal.w);
  shape = vec4(tilt > 1e-6 ? vec2(normal.x, -normal.y) / tilt : vec2(1.0, 0.0), max(normal.z, least_flattening), radius);
  centre_nearness = vec2(nearness, nearness / panel.towards.w);
  gl_Position = clip_of(centre + from_centre);
}
