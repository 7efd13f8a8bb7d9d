in vec3 colour, ray;
flat in vec4 ball;
uniform mat4 projectionMatrix;
out vec4 pixel;
#ifdef SCREENED
uniform float ballOpacity;
// A pixel in sixteen for each step, evenly spread (ordered dithering).
const float kThresholds[16] = float[16](0.0, 8.0, 2.0, 10.0, 12.0, 4.0, 14.0, 6.0, 3.0, 11.0, 1.0, 9.0, 15.0, 7.0, 13.0, 5.0);
#endif

const float kPowerShift = 0.05;  // At most 0.0125 of the model.

void main() {
#ifdef SCREENED
  // Pixels are left out in all balls alike, so that what they hide is seen between them, without an order of drawing.
  ivec2 place = ivec2(gl_FragCoord.xy) & 3;
  if (kThresholds[4 * place.y + place.x] + 0.5 > 16.0 * ballOpacity) discard;
#endif
  vec3 direction = normalize(ray);
  float along = dot(direction, ball.xyz);
  vec3 beside = ball.xyz - along * direction;
  float half_chord = sqrt(ball.w * ball.w - dot(beside, beside));
  if (!(half_chord >= 0.0)) discard;
  vec3 hit = (along - half_chord) * direction;
  vec3 normal = (hit - ball.xyz) / ball.w;
#ifdef PICKED
  // Glass: clear in the middle, dense at the rim.
  float grazing = 1.0 - max(dot(normal, -direction), 0.0);
  float cover = 0.14 + 0.66 * pow(grazing, 2.5);
  pixel = vec4(shade(colour, normal) * cover, cover);
#else
  bool cut = cut_away(hit);
  if (cut) {
    // Where the plane cuts the ball, its flat side is drawn.
    if (cut_away((along + half_chord) * direction)) discard;
    hit = -cutPlane.w / dot(cutPlane.xyz, direction) * direction;
  }
  vec3 seen = hit;
  // All flat sides lie in one plane: the ball with the least power, |p - c|^2 - r^2, is drawn in front.
  if (cut) seen += kPowerShift * (dot(hit - ball.xyz, hit - ball.xyz) - ball.w * ball.w) * direction;
  vec4 projected = projectionMatrix * vec4(seen, 1.0);
  gl_FragDepth = 0.5 * projected.z / projected.w + 0.5;
  // Flat sides are not shaded, so that their colours can be read.
  pixel = vec4(cut ? 0.94 * colour : shade(colour, normal), 1.0);
#endif
}
