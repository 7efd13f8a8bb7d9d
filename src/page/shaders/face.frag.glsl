in vec4 colour;
in vec3 viewNormal, place;
uniform float surfaceOpacity;
out vec4 pixel;

void main() {
  if (cut_away(place) || left_out(surfaceOpacity)) discard;
  vec3 normal = normalize(viewNormal);
  if (dot(normal, place) > 0.0) normal = -normal;
  float light = 0.62 + 0.44 * max(dot(normal, kKeyLight), 0.0);
  pixel = vec4(min(colour.rgb * light, 1.0), 1.0);
}
