in vec3 colour, place;
out vec4 pixel;

void main() {
  if (cut_away(place)) discard;
  pixel = vec4(colour * 0.92, 1.0);
}
