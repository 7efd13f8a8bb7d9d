// Marks are squares of six corners without attributes: the vertex index gives the mark and the corner.
struct Mark {
  vec4 centre;  // w: radius
  vec4 normal;  // w: position in the palette
  vec4 seen;    // for a ball: left, top, right and bottom of its visible part, pixels of the panel
};
layout(set = 0, binding = 0) readonly buffer Marks { Mark marks[]; };

Mark mark() { return marks[gl_VertexIndex / 6]; }

vec2 corner() {  // -1 or 1 each
  int i = gl_VertexIndex % 6;
  return vec2(i == 1 || i == 2 || i == 4 ? 1.0 : -1.0, i == 2 || i == 4 || i == 5 ? 1.0 : -1.0);
}
