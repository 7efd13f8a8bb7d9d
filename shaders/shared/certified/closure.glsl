// Winding numbers of open meshes, as accurate as float allows (docs/theory.md, "Outside"). The triangles between the
// open edges of a mesh and their apexes close it, and the winding numbers of the closed mesh are whole. Those triangles
// are few and are summed one by one. A ray gives the whole number, or else a rough number determines it; the sum is
// subtracted to obtain the number of the mesh itself. Include winding.glsl and signed_crossings.glsl before, and declare
// `open_edges`.
#ifndef MEDIAL_VK_CLOSURE_GLSL
#define MEDIAL_VK_CLOSURE_GLSL

const float kSumRounding = 1e-4;  // of the sum of solid angles in a walk of the tree, over 4 pi
// Of one solid angle over 4 pi (docs/theory.md, "Rounding"), where its tangent is ill-conditioned, and of atan itself,
// for which Vulkan allows 4096 units in the last place.
const float kTangentRounding = 4e-7, kAtanRounding = 2.5e-4;

// False: the mesh has no open edges, and a driver need not translate the code for them.
layout(constant_id = 1) const bool kIsOpen = true;
// The winding number far away: 1 where the triangles bound the outside of a mesh and are turned over, else 0
// (docs/theory.md, "The complement").
layout(constant_id = 2) const uint kFarNumber = 0u;

struct Closure {
  float number;         // winding number of the triangles that close the mesh
  Crossings crossings;  // of the ray with them
  float error;          // of the number, up to a whole number
  float slope;          // bound of the change of the mesh's winding number per length, within the given radius
  vec3 gradient;        // of the number at the point, or its opposite
  float bend;           // half of the greatest second derivative within the radius
};

// The integral of r x dl / |r|^3 along an edge, where r goes from p to l: in closed form, without cancellation if the
// edge is seen under a large angle.
vec3 gradient_of_edge(vec3 a, vec3 b) {
  vec3 across = cross(a, b - a);
  float la = length(a), lb = length(b), along = dot(a, b);
  float inverse = along > 0.0 ? 1.0 / max(la * lb + along, 1e-30)
                              : (la * lb - along) / max(dot(across, across), 1e-30);
  return across * ((la + lb) * inverse / max(la * lb, 1e-30));
}

// The same as winding_of_triangle, with a bound of its error. In the triangle's plane the value is 0 or 1/2; whether +1/2
// or -1/2 does not matter for a rough number, and a ray does not count there. On an edge, where all accuracy is lost, the
// bound is as large as the value.
vec2 winding_of_closing_triangle(vec3 p, OpenEdge e) {
  vec3 a = e.from.xyz - p, b = e.to.xyz - p, c = e.apex.xyz - p;
  float la = length(a), lb = length(b), lc = length(c), product = la * lb * lc;
  float volume = dot(a, cross(e.to.xyz - e.from.xyz, e.apex.xyz - e.from.xyz));
  float spread = product + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  float size = length(vec2(volume, spread));
  float scale = product + la * length(e.to.xyz - e.from.xyz) * length(e.apex.xyz - e.from.xyz);
  float number = size > 0.0 ? 2.0 * atan(volume, spread) / kFourPi : 0.0;
  return vec2(number, abs(number) * kAtanRounding + min(kTangentRounding * scale / max(size, 1e-30), 1.0));
}

// The gradient of the solid angle of a surface depends on its boundary alone (the law of Biot and Savart): it is at
// most the integral of 1 / |x - l|^2 along the boundary. Its derivatives are at most the integral of 2 / |x - l|^3,
// since the matrix of second derivatives of 1/|r| has the eigenvalues (1, 1, -2) / |r|^3. Of an edge at distance d that
// is longer than pi d, or 2 d, no more than that length counts (docs/theory.md, "Outside").
Closure closure_at(vec3 p, float radius, vec3 direction) {
  Closure sum = Closure(0.0, Crossings(0, true), 0.0, 0.0, vec3(0.0), 0.0);
  uint count = kIsOpen && step.open_edges <= kMostOpenEdges ? step.open_edges : 0u;
  for (uint i = 0u; i < count; ++i) {
    OpenEdge e = open_edges[i];
    vec2 part = winding_of_closing_triangle(p, e);
    sum.number += e.from.w * part.x;
    sum.error += e.from.w * part.y;
    vec3 edge = e.to.xyz - e.from.xyz, v = p - e.from.xyz;
    add_crossing(direction, -v, edge, e.apex.xyz - e.from.xyz, int(e.from.w), sum.crossings);
    float squared = dot(edge, edge);
    float away = length(v - clamp(dot(v, edge) / max(squared, 1e-30), 0.0, 1.0) * edge);
    float gap = away - radius - step.slack, size = sqrt(squared), inverse = 1.0 / max(gap, 1e-10);
    sum.slope += e.from.w * min(size, 3.1415927 * (away + step.slack)) * inverse * inverse;
    sum.bend += e.from.w * min(size, 2.0 * (away + step.slack)) * inverse * inverse * inverse;
    sum.gradient += e.from.w * gradient_of_edge(e.from.xyz - p, e.to.xyz - p);
  }
  sum.error += 1.2e-7 * float(count);  // of the additions: terms are at most 1/2
  sum.slope /= kFourPi;
  sum.bend /= kFourPi;
  sum.gradient /= kFourPi;
  return sum;
}

// The error is below 1/4, so that an error of the sum by 1/2 is noticed.
const float kRoughTolerance = 0.2;

// The winding number within the tolerance, by the tree alone.
Winding rough_winding_number(vec3 p, float tolerance) {
  Winding w = winding_number(p, tolerance);
  return Winding(float(kFarNumber) + w.number, w.bound, w.complete);
}

// The winding number of the mesh. `bound` is a large number if neither the ray nor a rough number determines the whole
// one.
Winding accurate_winding_number(vec3 p, vec3 direction, Closure closure) {
  Crossings crossings = signed_crossings(p, direction);
  float whole = float(crossings.sum + closure.crossings.sum), error = closure.error;
  bool complete = true;
  if (!crossings.known || !closure.crossings.known) {
    Winding rough = winding_number(p, kRoughTolerance);
    float all = rough.number + closure.number;
    whole = round(all);
    if (abs(all - whole) > rough.bound + kSumRounding + closure.error) error = 1e3;
    complete = rough.complete;
  }
  return Winding(float(kFarNumber) + whole - closure.number, error, complete);
}

#endif
