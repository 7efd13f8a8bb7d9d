#version 450
#extension GL_GOOGLE_include_directive : enable
// The lighting of a picture: from the layers to pixels. panel.cpp does the same on the CPU: change both; the tests
// compare them.
#include "panel.glsl"
layout(set = 0, binding = 1) readonly buffer Palette { vec4 palette[]; };
layout(set = 0, binding = 2) uniform sampler2D front;       // normal; w: 1 where a surface is present
layout(set = 0, binding = 3) uniform sampler2D back;        // as `front`
layout(set = 0, binding = 4) uniform sampler2D marks;       // x and y of the normal, position in the palette, rim or -1
layout(set = 0, binding = 5) uniform sampler2D mark_depth;
layout(location = 0) out vec4 pixel;  // linear light; the format of the image encodes it

const vec3 key_light = normalize(vec3(-0.45, 0.65, 0.62));  // view space, towards the light
const vec3 halfway = normalize(key_light + vec3(0.0, 0.0, 1.0));
const vec3 glass = vec3(0.22, 0.33, 0.48), ink = vec3(0.04, 0.055, 0.08), haze = vec3(0.85, 0.88, 0.91);
const vec3 low = vec3(0.80, 0.84, 0.885);

float diffuse(vec3 normal) { return max(dot(normal, key_light), 0.0); }
float highlight(vec3 normal, float sharpness) { return pow(max(dot(normal, halfway), 0.0), sharpness); }

vec3 palette_colour(float value) {
  uint last = panel.what.y - 1u, below = min(uint(value), last);
  return mix(palette[below].rgb, palette[min(below + 1u, last)].rgb, value - float(below));
}

// The far wall of the glass, seen from inside.
vec3 over_back_wall(vec3 colour, vec3 normal) {
  float facing = min(abs(normal.z), 1.0), light = 0.62 + 0.55 * diffuse(-normal);
  return mix(colour, glass * light, 0.12 + 0.30 * (1.0 - facing));
}

float taken_by(ivec2 at, ivec2 offset, float nearness, float unit, float reach, vec3 normal) {
  ivec2 there = at + offset;
  if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, ivec2(panel.layer.xy)))) return 0.0;
  if (texelFetch(marks, there, 0).w < 0.0) return 0.0;
  float other = nearness_of(texelFetch(mark_depth, there, 0).r);
  vec3 to = vec3(vec2(offset.x, -offset.y) / unit, 1.0 / nearness - 1.0 / other);
  float size = length(to);
  if (!(size > 0.0)) return 0.0;
  float share = size * unit / reach;
  return max(dot(normal, to) / size - 0.08, 0.0) / (1.0 + share * share);
}

// The part of the sky that neighbours leave visible: 1 on an open plain. Eight positions around the sample are tested,
// different ones for each sample of a pixel, on one spiral.
float openness(ivec2 at, float nearness, vec3 normal) {
  const int positions = 8;
  int side = int(panel.layer.z), samples = side * side;
  float unit = panel.towards.w * nearness, reach = min(panel.place.w * unit, panel.depth.w);
  int number = at.y % side * side + at.x % side;
  float taken = 0.0;
  for (int i = 0; i < positions; ++i) {
    float index = float(i * samples + number) + 0.5;
    float angle = 2.39996323 * index, radius = reach * sqrt(index / float(positions * samples));
    taken += taken_by(at, ivec2(round(radius * vec2(cos(angle), sin(angle)))), nearness, unit, reach, normal);
  }
  return 1.0 - 0.85 * min(1.6 * taken / float(positions), 1.0);
}

// A disc or a ball, lit by the sky, which nearby marks occlude, and by a lamp. Discs are darker at the rim, which
// distinguishes them, and paler farther away.
vec3 mark_colour(ivec2 at, vec4 mark) {
  vec3 normal = vec3(mark.xy, sqrt(max(1.0 - dot(mark.xy, mark.xy), 0.0)));
  float depth = texelFetch(mark_depth, at, 0).r, nearness = nearness_of(depth);
  float open = openness(at, nearness, normal), sky = 0.50 + 0.14 * normal.y;
  float edge = 1.0 - 0.22 * mark.w * mark.w * mark.w;
  vec3 lit = palette_colour(mark.z) * (open * edge * (sky + 0.62 * diffuse(normal)));
  if (panel.what.x == 1u) return lit + 0.10 * open * highlight(normal, 40.0);
  return mix(lit, haze, 0.05 * clamp(1.0 - depth, 0.0, 1.0));
}

// The near wall: clear where it faces the viewer, denser towards the outline (Schlick's curve), with a highlight.
vec3 over_front_wall(vec3 colour, vec3 normal) {
  vec3 outward = normal.z < 0.0 ? -normal : normal;
  float grazing = 1.0 - min(outward.z, 1.0), cover = 0.02 + 0.72 * grazing * grazing * grazing;
  float light = 0.62 + 0.62 * diffuse(outward);
  vec3 seen = mix(colour, min(glass * light, vec3(1.0)), cover);
  return mix(seen, vec3(1.0), 0.30 * highlight(outward, 48.0));
}

// True if the near wall ends or bends sharply within half a pixel to the right or below. Drawn as a thin line, this
// shows the outline and the creases of the shape.
bool on_line(ivec2 at, vec4 here) {
  const float crease = 0.80;
  int one = max(int(panel.layer.z) / 2, 1);
  ivec2 last = ivec2(panel.layer.xy) - 1;
  vec4 right = texelFetch(front, min(at + ivec2(one, 0), last), 0);
  vec4 below = texelFetch(front, min(at + ivec2(0, one), last), 0);
  if (here.w != right.w || here.w != below.w) return true;
  return here.w > 0.0 && (dot(here.xyz, right.xyz) < crease || dot(here.xyz, below.xyz) < crease);
}

vec3 sample_colour(ivec2 at, float height_share) {
  vec3 colour = mix(vec3(1.0), low, height_share * height_share);
  vec4 near = texelFetch(front, at, 0), far = texelFetch(back, at, 0), mark = texelFetch(marks, at, 0);
  if (far.w > 0.0) colour = over_back_wall(colour, far.xyz);
  if (mark.w >= 0.0) colour = mark_colour(at, mark);
  if (near.w > 0.0) colour = over_front_wall(colour, near.xyz);
  return min(on_line(at, near) ? mix(colour, ink, 0.60) : colour, vec3(1.0));
}

void main() {
  int side = int(panel.layer.z);
  ivec2 first = ivec2(gl_FragCoord.xy) * side + int(panel.place.z);
  float height_share = (panel.place.x + gl_FragCoord.y) / panel.place.y;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) sum += sample_colour(first + ivec2(x, y), height_share);
  pixel = vec4(sum / float(side * side), 1.0);
}
