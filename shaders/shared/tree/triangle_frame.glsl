// Distance to a triangle in its own frame: the origin is the rounded corner a, n the unit normal of the exact triangle,
// t the direction of ab in its plane, and s = n x t, on the side of c. Five texels: (a, |ab|) (t, |ac|) (s, |bc|) (n,
// index in the input) (unit vectors of ac and bc in t and s). This takes 40 % less arithmetic than closest_point.glsl
// if one triangle is tested many times.
//
// With u = 2^-24: the error of e = p - a is u/2 per coordinate, that of the unit vectors the same, that of a dot
// product 3 u |e|; so that of x, y and h is 5 u |e|. Their products with unit vectors of the plane add 3 u |e|. Nothing
// cancels, however thin the triangle is. The error of the distance is less than 15 u (|p - a| + |edge|), plus 1.2e-7
// for rounded corners that are not in the plane: 3e-6 for a query in the unit box.
#ifndef MEDIAL_VK_TRIANGLE_FRAME_GLSL
#define MEDIAL_VK_TRIANGLE_FRAME_GLSL

struct TriangleFrame {
  vec4 a;
  vec4 t;
  vec4 s;
  vec4 n;
  vec4 edges;
};

layout(set = 0, binding = FRAME_STORAGE_BINDING) readonly buffer FrameStorage { vec4 frame_storage[]; };
layout(set = 0, binding = FRAME_TEXEL_BINDING) uniform samplerBuffer frame_texels;

vec4 frame_texel(uint i) { return kUseTexels ? texelFetch(frame_texels, int(i)) : frame_storage[i]; }

TriangleFrame load_frame(uint t) {
  return TriangleFrame(frame_texel(5u * t), frame_texel(5u * t + 1u), frame_texel(5u * t + 2u),
                       frame_texel(5u * t + 3u), frame_texel(5u * t + 4u));
}

// The built-in functions handle NaN, which costs lavapipe three instructions instead of one.
float lesser(float a, float b) {
  precise float result = a < b ? a : b;
  return result;
}
float greater(float a, float b) {
  precise float result = a > b ? a : b;
  return result;
}

// Distance beyond the ends of [0, size]; its sign is not used.
float beyond(float x, float size) { return x - lesser(greater(x, 0.0), size); }

// Squared; times `prefer` where the foot of the perpendicular lies inside.
float squared_distance_to_frame(vec3 p, TriangleFrame f, float prefer) {
  vec3 e = p - f.a.xyz;
  float x = dot(e, f.t.xyz), y = dot(e, f.s.xyz), h = dot(e, f.n.xyz);
  float x_b = x - f.a.w;
  float across_ac = x * f.edges.y - y * f.edges.x, across_bc = y * f.edges.z - x_b * f.edges.w;
  float beyond_ab = beyond(x, f.a.w);
  float beyond_ac = beyond(x * f.edges.x + y * f.edges.y, f.t.w);
  float beyond_bc = beyond(x_b * f.edges.z + y * f.edges.w, f.s.w);
  float d_ab = y * y + beyond_ab * beyond_ab;
  float d_ac = across_ac * across_ac + beyond_ac * beyond_ac;
  float d_bc = across_bc * across_bc + beyond_bc * beyond_bc;
  bool inside = lesser(y, lesser(across_ac, across_bc)) > 0.0;
  float height = h * h;
  return inside ? height * prefer : height + lesser(d_ab, lesser(d_ac, d_bc));
}

#endif
