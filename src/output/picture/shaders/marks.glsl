// Marks are squares of six corners without attributes: their numbers say which mark and which corner.
struct Mark {
  vec4 centre;  // w: radius
  vec4 normal;  // w: place in the palette
  vec4 seen;    // of a ball: left, top, right and bottom of where it is seen, pixels of the panel
};
layout(set = 0, binding = 0) readonly buffer Marks { Mark marks[]; };

Mark mark() { return marks[gl_VertexIndex / 6]; }

vec2 corner() {  // -1 or 1 each
  int i = gl_VertexIndex % 6;
  return vec2(i == 1 || i == 2 || i == 4 ? 1.0 : -1.0, i == 2 || i == 4 || i == 5 ? 1.0 : -1.0);
}
