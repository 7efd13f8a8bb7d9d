// Lines some pixels wide, six corners each; of several (SEVERAL), the ends are attributes of their corners.
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec2 viewport;
uniform float width;
#ifdef SEVERAL
in vec3 from, to;
#else
uniform vec3 from, to;
#endif

const vec2 kCorners[6] = vec2[](vec2(0, -1), vec2(1, -1), vec2(1, 1), vec2(0, -1), vec2(1, 1), vec2(0, 1));

void main() {
  vec4 a = projectionMatrix * (modelViewMatrix * vec4(from, 1.0));
  vec4 b = projectionMatrix * (modelViewMatrix * vec4(to, 1.0));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1, 0);
  vec2 corner = kCorners[gl_VertexID % 6];  // x: the end; y: the side.
  vec4 end = corner.x < 0.5 ? a : b;
  vec2 shift = corner.y * width * vec2(-along.y, along.x) + (corner.x * 2.0 - 1.0) * 0.5 * width * along;
  gl_Position = end + vec4(shift / viewport * end.w, 0, 0);
}
