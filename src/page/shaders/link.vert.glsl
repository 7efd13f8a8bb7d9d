// Thin lines in the colours of their ends.
uniform mat4 projectionMatrix, modelViewMatrix;
in vec3 position;
in vec4 paint;
out vec3 colour, place;

void main() {
  place = (modelViewMatrix * vec4(position, 1.0)).xyz;
  colour = paint.rgb;
  gl_Position = projectionMatrix * vec4(place, 1.0);
}
