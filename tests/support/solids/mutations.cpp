#include "support/solids/mutations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

// The engine is specified by the standard; its distributions are not, so numbers are computed here.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Point point(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

 private:
  std::mt19937_64 engine_;
};

std::uint32_t some_face(const Mesh& mesh, Random& random) { return random.below(mesh.triangles.size()); }
std::uint32_t some_vertex(const Mesh& mesh, Random& random) { return random.below(mesh.vertices.size()); }

void delete_faces(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(3); i > 0 && mesh.triangles.size() > 1; --i)
    mesh.triangles.erase(mesh.triangles.begin() + some_face(mesh, random));
}

void duplicate_faces(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(5); i > 0; --i) {
    Triangle t = mesh.triangles[some_face(mesh, random)];
    if (random.below(2) == 0) std::swap(t[0], t[1]);
    mesh.triangles.push_back(t);
  }
}

void flip_faces(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(4); i > 0; --i) {
    Triangle& t = mesh.triangles[some_face(mesh, random)];
    std::swap(t[0], t[1]);
  }
}

void flip_all(Mesh& mesh, Random&) { turn_over(mesh); }

void move_vertices(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(4); i > 0; --i) {
    const Point offset = random.point(0.4);
    Point& p = mesh.vertices[some_vertex(mesh, random)];
    for (int axis = 0; axis < 3; ++axis) p[axis] += offset[axis];
  }
}

// Two corners of a face at one point: it has no area, and its neighbours fold.
void collapse_edges(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(3); i > 0; --i) {
    const Triangle t = mesh.triangles[some_face(mesh, random)];
    mesh.vertices[t[0]] = mesh.vertices[t[1]];
  }
}

// A corner almost on the opposite edge: aspect 1e8.
void make_needles(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(3); i > 0; --i) {
    const Triangle t = mesh.triangles[some_face(mesh, random)];
    const Point a = mesh.vertices[t[0]], b = mesh.vertices[t[1]];
    const double share = random.between(0.1, 0.9);
    for (int axis = 0; axis < 3; ++axis) {
      const double on_edge = a[axis] + share * (b[axis] - a[axis]);
      mesh.vertices[t[2]][axis] = on_edge + 1e-8 * (mesh.vertices[t[2]][axis] - on_edge);
    }
  }
}

// A third face on an edge.
void add_fins(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(2); i > 0; --i) {
    const Triangle t = mesh.triangles[some_face(mesh, random)];
    Point tip = mesh.vertices[t[0]];
    const Point offset = random.point(0.5);
    for (int axis = 0; axis < 3; ++axis) tip[axis] += offset[axis];
    mesh.vertices.push_back(tip);
    mesh.triangles.push_back({t[0], t[1], static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
  }
}

void pinch(Mesh& mesh, Random& random) {
  const std::uint32_t a = some_vertex(mesh, random), b = some_vertex(mesh, random);
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), a, b);
}

Mesh shrunk(const Mesh& mesh, double factor) {
  Mesh inner = mesh;
  Point middle = {0, 0, 0};
  for (const Point& p : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) middle[axis] += p[axis] / static_cast<double>(mesh.vertices.size());
  for (Point& p : inner.vertices)
    for (int axis = 0; axis < 3; ++axis) p[axis] = middle[axis] + factor * (p[axis] - middle[axis]);
  return inner;
}

void add_cavity(Mesh& mesh, Random& random) {
  Mesh inner = shrunk(mesh, random.between(0.2, 0.6));
  if (random.below(3) > 0) turn_over(inner);
  append(mesh, inner);
}

void add_overlapping_copy(Mesh& mesh, Random& random) {
  Mesh copy = mesh;
  translate(copy, random.point(0.4));
  append(mesh, copy);
}

void add_coincident_copy(Mesh& mesh, Random& random) {
  Mesh copy = mesh;
  if (random.below(2) == 0) turn_over(copy);
  append(mesh, copy);
}

void add_distant_part(Mesh& mesh, Random& random) {
  Mesh part = make_box({0.3, 0.4, 0.5});
  translate(part, {3 + random.between(0, 1), 0, 0});
  append(mesh, part);
}

void add_soup(Mesh& mesh, Random& random) {
  for (std::uint32_t i = 1 + random.below(6); i > 0; --i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(random.point(1.2));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

void make_huge(Mesh& mesh, Random&) { scale(mesh, 1e18); }
void make_tiny(Mesh& mesh, Random&) { scale(mesh, 1e-18); }
void move_far(Mesh& mesh, Random& random) { translate(mesh, random.point(1e6)); }

struct Step {
  const char* name;
  void (*apply)(Mesh&, Random&);
};

constexpr Step kSteps[] = {
    {"faces deleted", delete_faces},
    {"faces duplicated", duplicate_faces},
    {"faces flipped", flip_faces},
    {"all flipped", flip_all},
    {"vertices moved", move_vertices},
    {"edges collapsed", collapse_edges},
    {"needles", make_needles},
    {"fins", add_fins},
    {"two vertices made one", pinch},
    {"a shell inside", add_cavity},
    {"an overlapping copy", add_overlapping_copy},
    {"a coincident copy", add_coincident_copy},
    {"a distant part", add_distant_part},
    {"a soup of triangles", add_soup},
    {"scaled by 1e18", make_huge},
    {"scaled by 1e-18", make_tiny},
    {"moved far away", move_far},
};

std::pair<const char*, Mesh> some_solid(Random& random) {
  switch (random.below(5)) {
    case 0:
      return {"box", make_box({1, 0.8, 0.6})};
    case 1:
      return {"L", make_l_shape(1.0, 0.35, 0.4)};
    case 2:
      return {"torus", make_torus(0.7, 0.3, 10, 16)};
    case 3:
      return {"plate with a hole", make_plate_with_hole(1.0, 0.2, 0.4)};
    default:
      return {"sphere", make_sphere(0.6, 120)};
  }
}

}  // namespace

std::size_t mutation_count() { return std::size(kSteps); }

Mutation make_mutation(std::uint64_t seed) {
  Random random(seed);
  auto [name, mesh] = some_solid(random);
  rotate(mesh, {1, 2, 3}, random.between(0, 3));
  Mutation out{name, std::move(mesh)};
  const std::uint32_t steps = 1 + random.below(3);
  for (std::uint32_t i = 0; i < steps; ++i) {
    const Step& step = kSteps[i == 0 ? seed % std::size(kSteps) : random.below(std::size(kSteps))];
    step.apply(out.mesh, random);
    out.description += std::string(", ") + step.name;
  }
  return out;
}

}  // namespace medial_vk::test
