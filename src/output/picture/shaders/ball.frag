#version 450
#extension GL_GOOGLE_include_directive : enable
#include "panel.glsl"
layout(location = 0) in vec2 at;
layout(location = 1) flat in vec4 ball;
layout(location = 2) flat in float value;
layout(location = 0) out vec4 seen;  // x and y of the normal, position in the palette, 0

void main() {
  // The ray through the sample is t * d. With w from its point at the depth of the centre to the centre, nothing large
  // cancels: the distance of the ray from the centre is |d x w| / |d|.
  vec3 d = vec3((at - vec2(panel.right.w, panel.up.w)) / panel.towards.w, 1.0);
  vec3 w = vec3(ball.xy - ball.z * d.xy, 0.0), crossed = cross(d, w);
  float square = dot(d, d), root = ball.w * ball.w * square - dot(crossed, crossed);
  if (root <= 0.0) discard;
  float along = (dot(d, w) - sqrt(root)) / square;
  gl_FragDepth = depth_of(1.0 / (ball.z + along));
  vec3 normal = normalize((along * d - w) * vec3(1.0, -1.0, -1.0));
  seen = vec4(normal.xy, value, 0.0);
}
