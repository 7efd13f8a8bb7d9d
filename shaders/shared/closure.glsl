// Winding numbers of open meshes as exactly as float allows (docs/theory.md, "Outside"). With the triangles between its
// open edges and their apexes a mesh is closed, and its winding numbers are whole; those triangles are few, and summed
// one by one. So a rough winding number tells the whole one, and that less the sum is the number of the mesh itself.
// Include winding.glsl before, and declare `open_edges`.
#ifndef MEDIAL_VK_CLOSURE_GLSL
#define MEDIAL_VK_CLOSURE_GLSL

// Of a sum of solid angles in float, over 4 pi: of those near the point, and for each of the others.
const float kSumRounding = 1e-4, kTermRounding = 3e-7;

struct Closure {
  float number;  // winding number of the triangles that close the mesh
  float slope;   // within the radius that was asked, the winding number of the mesh changes no faster
};

// The gradient of the solid angle of a surface depends on its boundary alone (the law of Biot and Savart): it is at most
// the integral of 1 / |x - l|^2 along the boundary.
Closure closure_at(vec3 p, float radius) {
  Closure sum = Closure(0.0, 0.0);
  uint count = step.open_edges <= kMostOpenEdges ? step.open_edges : 0u;
  for (uint i = 0u; i < count; ++i) {
    OpenEdge e = open_edges[i];
    vec3 edge = e.to.xyz - e.from.xyz;
    TriangleTexels t;
    t.a = vec4(e.from.xyz, 0.0);
    t.ab = vec4(edge, 0.0);
    t.ac = vec4(e.apex.xyz - e.from.xyz, 0.0);
    t.normal = vec4(0.0);
    sum.number += e.from.w * winding_of_triangle(p, t);
    vec3 v = p - e.from.xyz;
    float squared = dot(edge, edge);
    float gap = length(v - clamp(dot(v, edge) / max(squared, 1e-30), 0.0, 1.0) * edge) - radius - step.slack;
    sum.slope += gap > 0.0 ? e.from.w * sqrt(squared) / (gap * gap) : 1e30;
  }
  sum.slope /= kFourPi;
  return sum;
}

// `rough`: the winding number of the mesh, wrong by less than 1/2.
float exact_winding_number(float rough, Closure closure) { return round(rough + closure.number) - closure.number; }

float closure_rounding() { return kSumRounding + kTermRounding * float(step.open_edges); }

#endif
