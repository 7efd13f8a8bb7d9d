// Triangles of one of two colours.
uniform mat4 projectionMatrix, modelViewMatrix;
in vec3 position;
in float inked;
out vec3 colour, place;

void main() {
  place = (modelViewMatrix * vec4(position, 1.0)).xyz;
  colour = mix(vec3(1.0), vec3(0.08, 0.08, 0.10), inked);
  gl_Position = projectionMatrix * vec4(place, 1.0);
}
