// A medial point as a small shaded ball: a sprite that always faces the viewer.
uniform float pointRadius;
uniform float pixelsPerUnit;  // At distance 1.
uniform float pixelRatio;     // The device's pixels per pixel of the page.
out vec3 colour;

void main() {
  MedialPoint point = medial_point(gl_VertexID);
  vec4 place = modelViewMatrix * vec4(point.centre, 1.0);
  if (filtered_out(point) || cut_away(place.xyz)) {
    gl_Position = nowhere();
    return;
  }
  gl_Position = projectionMatrix * place;
  gl_PointSize = clamp(2.0 * pointRadius * pixelsPerUnit / -place.z, 2.5 * pixelRatio, 64.0);
  colour = attribute_colour(point);
}
