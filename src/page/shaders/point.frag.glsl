in vec3 colour;
out vec4 pixel;

void main() {
  vec2 q = vec2(2.0, -2.0) * (gl_PointCoord - 0.5);
  float square = dot(q, q);
  if (square > 1.0) discard;
  pixel = vec4(shade(colour, vec3(q, sqrt(1.0 - square))), 1.0);
}
