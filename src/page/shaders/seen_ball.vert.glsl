// The part of a ball that can be seen, as the rectangle of the screen that holds it (motion/seen_parts.js). The fragments
// solve the equation of the ball, as for ball.vert.glsl.
uniform sampler2D rectangles;  // Of each ball in the order of drawing: left, bottom, right, top, from -1 to 1.
out vec3 colour, ray;
flat out vec4 ball;  // Centre and radius in view space.

void main() {
  int number = gl_VertexID / 6, corner = gl_VertexID % 6;
  MedialPoint point = medial_point(number);
  vec4 rectangle = texelFetch(rectangles, texel_of(number, textureSize(rectangles, 0).x), 0);
  vec2 at = vec2(corner == 1 || corner == 2 || corner == 4 ? rectangle.z : rectangle.x,
                 corner == 2 || corner == 4 || corner == 5 ? rectangle.w : rectangle.y);
  gl_Position = vec4(at, 0.0, 1.0);
  ray = vec3((at.x + projectionMatrix[2][0]) / projectionMatrix[0][0],
             (at.y + projectionMatrix[2][1]) / projectionMatrix[1][1], -1.0);
  ball = vec4((modelViewMatrix * vec4(point.centre, 1.0)).xyz, point.radius);
  colour = attribute_colour(point);
}
