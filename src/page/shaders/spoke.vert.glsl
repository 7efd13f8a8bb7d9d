// Two lines from a centre to the contacts of its ball.
out vec3 colour, place;

void main() {
  MedialPoint point = medial_point(gl_VertexID / 4);
  if (filtered_out(point)) {
    gl_Position = nowhere();
    return;
  }
  float along = float(gl_VertexID & 1);
  vec3 spoke = spoke_of(point, gl_VertexID >> 1 & 1);
  place = (modelViewMatrix * vec4(point.centre + along * point.radius * spoke, 1.0)).xyz;
  gl_Position = projectionMatrix * vec4(place, 1.0);
  colour = attribute_colour(point);
}
