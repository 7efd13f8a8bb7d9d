// Definitions that all kernels of the page share. Positions are in the page's own units: the mesh lies around 0 and has
// size 1.
precision highp float;
precision highp int;
uniform vec4 cutPlane;  // In view space; the side with dot(xyz, p) + w >= 0 is kept.

const vec3 kKeyLight = vec3(-0.4479, 0.6470, 0.6171);  // View space, towards the light.

bool cut_away(vec3 viewPosition) { return dot(cutPlane.xyz, viewPosition) + cutPlane.w < 0.0; }

// Light from the key light, and a little from all directions, so that nothing is black.
vec3 shade(vec3 colour, vec3 normal) {
  float key = max(dot(normal, kKeyLight), 0.0);
  float highlight = pow(max(dot(normal, normalize(kKeyLight + vec3(0, 0, 1))), 0.0), 40.0);
  return min(colour * (0.50 + 0.62 * key) + 0.16 * highlight, 1.0);
}
