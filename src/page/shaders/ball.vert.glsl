// A ball as a square that covers it on the screen. The fragments solve its equation, so that it is round at any size
// and requires only six corners.
out vec3 colour, ray;
flat out vec4 ball;  // Centre and radius in view space.

const vec2 kCorners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));

void main() {
  MedialPoint point = medial_point(gl_VertexID / 6);
  vec3 middle = (modelViewMatrix * vec4(point.centre, 1.0)).xyz;
  float radius = point.radius;
  float away = length(middle);
  if (filtered_out(point) || away <= 1.01 * radius) {  // A ball around the eye is not drawn.
    gl_Position = nowhere();
    return;
  }
  // The square is perpendicular to the line of sight, and as large as the cross-section of the cone of tangents there.
  float size = radius * away / sqrt(away * away - radius * radius);
  vec3 towards = middle / away;
  vec3 other = abs(towards.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0);
  vec3 u = normalize(cross(towards, other));
  vec3 v = cross(u, towards);
  vec2 corner = kCorners[gl_VertexID % 6];
  ray = middle + 1.02 * size * (corner.x * u + corner.y * v);
  ball = vec4(middle, radius);
  gl_Position = projectionMatrix * vec4(ray, 1.0);
  colour = attribute_colour(point);
}
