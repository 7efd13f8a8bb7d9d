// A medial point by its index: its position, its values, its colour, and the result of the filter. The numbers are read
// from textures instead of attributes of instances: a hundred thousand instances of three corners each are slow on many
// devices, while one list of three hundred thousand corners is not.
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec2 leastAngleRadius;
uniform ivec2 shownPoints;        // The first index that is shown, and the first one behind these.
uniform int insidePoints;         // The first index of a point outside of the mesh.
uniform int colourBy;             // A component of `values`, or 4: the side.
uniform vec2 colourRange;
uniform sampler2D colourMap;      // Row 0: the map of numbers; row 1: one colour per sheet, in turn.
#ifdef PICKED
uniform vec4 picked;              // Centre and radius.
uniform vec3 pickedColour;
#else
uniform sampler2D places;         // Centre and radius.
uniform sampler2D others;         // Object angle, flux, sheet.
uniform highp isampler2D spokes;  // Two texels per point, in units of 1/32767.
uniform highp usampler2D order;   // The order in which balls are drawn (ORDERED).
#endif

struct MedialPoint {
  vec3 centre;
  float radius;
  vec4 values;  // Object angle, radius, flux, sheet.
  int index;
};

ivec2 texel_of(int index, int width) { return ivec2(index % width, index / width); }

#ifdef PICKED
MedialPoint medial_point(int number) { return MedialPoint(picked.xyz, picked.w, vec4(0), number); }
#else
MedialPoint medial_point(int number) {
#ifdef ORDERED
  int index = int(texelFetch(order, texel_of(number, textureSize(order, 0).x), 0).r);
#else
  int index = number;
#endif
  ivec2 texel = texel_of(index, textureSize(places, 0).x);
  vec4 place = texelFetch(places, texel, 0);
  vec4 other = texelFetch(others, texel, 0);
  return MedialPoint(place.xyz, place.w, vec4(other.x, place.w, other.yz), index);
}

// `which`: 0 or 1.
vec3 spoke_of(MedialPoint point, int which) {
  ivec2 texel = texel_of(2 * point.index + which, textureSize(spokes, 0).x);
  return vec3(texelFetch(spokes, texel, 0).xyz) / 32767.0;
}
#endif

bool filtered_out(MedialPoint point) {
#ifdef PICKED
  return false;
#else
  return point.values.x < leastAngleRadius.x || point.values.y < leastAngleRadius.y || point.index < shownPoints.x
    || point.index >= shownPoints.y;
#endif
}

// A position outside of the picture.
vec4 nowhere() { return vec4(2.0, 2.0, 2.0, 1.0); }

vec3 attribute_colour(MedialPoint point) {
#ifdef PICKED
  return pickedColour;
#else
  if (colourBy == 3) {
    if (point.values.w < 0.0) return vec3(0.55, 0.58, 0.62);
    return texelFetch(colourMap, ivec2(int(mod(point.values.w, 12.0)), 1), 0).rgb;
  }
  if (colourBy == 4) return texelFetch(colourMap, ivec2(point.index < insidePoints ? 0 : 1, 1), 0).rgb;
  float share = (point.values[colourBy] - colourRange.x) / max(colourRange.y - colourRange.x, 1e-12);
  return texelFetch(colourMap, ivec2(int(clamp(share, 0.0, 1.0) * 255.0 + 0.5), 0), 0).rgb;
#endif
}
