uniform mat4 projectionMatrix, modelViewMatrix;
in vec3 position;
#ifndef PLAIN
in vec3 normal;
out vec3 viewNormal;
#endif
out vec3 place;
#ifdef PAINTED
in vec4 paint;
out vec3 paintColour;
#endif
invariant gl_Position;  // The wall is drawn where its depth has been written before.

void main() {
  place = (modelViewMatrix * vec4(position, 1.0)).xyz;
#ifndef PLAIN
  viewNormal = mat3(modelViewMatrix) * normal;
#endif
#ifdef PAINTED
  paintColour = paint.rgb;
#endif
  gl_Position = projectionMatrix * vec4(place, 1.0);
}
