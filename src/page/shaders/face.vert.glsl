// Triangles of the surface between sites, in the colours of their corners; an alpha of 0 leaves a triangle out.
uniform mat4 projectionMatrix, modelViewMatrix;
in vec3 position, normal;
in vec4 paint;
out vec4 colour;
out vec3 viewNormal, place;

void main() {
  place = (modelViewMatrix * vec4(position, 1.0)).xyz;
  viewNormal = mat3(modelViewMatrix) * normal;
  colour = paint;
  gl_Position = paint.a > 0.0 ? projectionMatrix * vec4(place, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
