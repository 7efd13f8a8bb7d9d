// A disc at a medial point, in the plane of its sheet, which bisects the angle between the spokes; drawn as a triangle
// around the disc.
uniform float discRadius;
out vec3 colour, normal, place;
out vec2 corner;

const vec2 kCorners[3] = vec2[](vec2(-1.7321, -1.0), vec2(1.7321, -1.0), vec2(0.0, 2.0));

void main() {
  MedialPoint point = medial_point(gl_VertexID / 3);
  vec4 middle = modelViewMatrix * vec4(point.centre, 1.0);
  if (filtered_out(point) || cut_away(middle.xyz)) {
    gl_Position = nowhere();
    return;
  }
  vec3 across = normalize(spoke_of(point, 1) - spoke_of(point, 0));
  vec3 other = abs(across.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
  vec3 u = normalize(cross(across, other));
  vec3 v = cross(across, u);
  corner = kCorners[gl_VertexID % 3];
  vec3 shift = min(discRadius, point.radius) * (corner.x * u + corner.y * v);
  place = (modelViewMatrix * vec4(point.centre + shift, 1.0)).xyz;
  normal = mat3(modelViewMatrix) * across;
  gl_Position = projectionMatrix * vec4(place, 1.0);
  colour = attribute_colour(point);
}
