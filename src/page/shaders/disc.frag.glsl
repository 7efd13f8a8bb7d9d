in vec3 colour, normal, place;
in vec2 corner;
out vec4 pixel;

void main() {
  float rim = length(corner);
  if (rim > 1.0 || cut_away(place)) discard;
  vec3 n = normalize(normal);
  float light = 0.66 + 0.46 * abs(dot(n, kKeyLight));
  pixel = vec4(min(colour * light * (1.0 - 0.14 * rim * rim * rim), 1.0), 1.0);
}
