in vec3 colour, ray;
flat in vec4 ball;
uniform mat4 projectionMatrix;
out vec4 pixel;
#ifdef SCREENED
uniform float ballOpacity;
#endif

const float kPowerShift = 0.05;  // At most 0.0125 of the model.

void main() {
#ifdef SCREENED
  if (left_out(ballOpacity)) discard;
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
