// The inputs of all stages (PanelConstants in drawing_pipelines.h; 112 of the 128 bytes that every device has).
layout(push_constant) uniform Panel {
  vec4 right, up, towards;  // rows of the rotation; w: offset x and y in samples of this tile, pixels per unit
  vec4 layer;               // width and height in samples, samples per pixel and side, distance of the eye
  vec4 depth;               // least nearness, one over its range, least radius of a disc and greatest reach in samples
  vec4 place;               // top in the picture and height of the picture in pixels, border in samples, reach in units
  uvec4 what;               // x: 1 for balls, else 0; y: colours in the palette; z: left of the tile in the panel, pixels
} panel;

vec3 turn(vec3 direction) {
  return vec3(dot(panel.right.xyz, direction), dot(panel.up.xyz, direction), dot(panel.towards.xyz, direction));
}

// 0 at the farthest and 1 at the nearest visible point.
float depth_of(float nearness) { return (nearness - panel.depth.x) * panel.depth.y; }
float nearness_of(float depth) { return panel.depth.x + depth / panel.depth.y; }

// Maps from samples of the tile, y down.
vec4 clip_of(vec2 at) { return vec4(2.0 * at / panel.layer.xy - 1.0, 0.5, 1.0); }
