// The surface as glass. BACK: the far wall, seen from inside. PLAIN: one colour (creases), or depth alone. PAINTED:
// colours of corners.
in vec3 place;
uniform vec3 glass, crease;
uniform float density;  // 0: invisible, 1: glass, large: opaque.
#ifndef PLAIN
in vec3 viewNormal;
#endif
#ifdef PAINTED
in vec3 paintColour;
uniform float painted;
vec3 surface() { return mix(glass, paintColour, painted); }
#else
vec3 surface() { return glass; }
#endif
out vec4 pixel;

#ifdef PLAIN
void main() {
  if (cut_away(place)) discard;
  float cover = 0.45 * min(density, 1.0);
  pixel = vec4(glass * cover, cover);
}
#else
void main() {
  if (cut_away(place)) discard;
  vec3 eye = -normalize(place);
  vec3 normal = normalize(viewNormal);
  if (dot(normal, eye) < 0.0) normal = -normal;
  float grazing = 1.0 - min(dot(normal, eye), 1.0);
#ifdef BACK
  float cover = 0.12 + 0.26 * grazing;
  vec3 colour = surface() * (0.62 + 0.38 * max(dot(normal, kKeyLight), 0.0));
#else
  // Clear where it faces the viewer, denser towards the outline (Schlick's curve), with a highlight.
  float cover = 0.08 + 0.62 * grazing * grazing * grazing;
  vec3 colour = min(surface() * (0.70 + 0.42 * max(dot(normal, kKeyLight), 0.0)), 1.0);
  float highlight = 0.35 * pow(max(dot(normal, normalize(kKeyLight + vec3(0, 0, 1))), 0.0), 48.0);
  colour = mix(colour, vec3(1.0), highlight);
  cover = mix(cover, 1.0, highlight);
  // The outline.
  float outline = smoothstep(0.70, 0.98, grazing);
  colour = mix(colour, crease, 0.45 * outline);
  cover = mix(cover, 0.9, 0.6 * outline);
#endif
  cover = 1.0 - pow(1.0 - cover, density);
  pixel = vec4(colour * cover, cover);
}
#endif
