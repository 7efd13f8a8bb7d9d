#include "support/distances/distance_solids.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "medial_vk/prepare.h"
#include "support/eigen_points.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/mutations.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

Mesh scaled(Mesh mesh, double by) {
  scale(mesh, by);
  return mesh;
}

Mesh turned(Mesh mesh) {
  rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

Mesh without_its_first_triangles(Mesh mesh, std::size_t count) {
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + static_cast<std::ptrdiff_t>(count));
  return mesh;
}

struct Named {
  std::string name;
  Mesh mesh;
  bool is_degenerate = false;
};

std::vector<Named> regular_meshes() {
  return {{"box", make_box({1, 1, 1})},
          {"sphere", make_sphere(0.5, 180)},
          {"torus", make_torus(0.5, 0.2, 12, 18)},
          {"cup", make_cup(0.5, 0.1, 0.8, 16)},
          {"L", make_l_shape(1, 0.3, 0.4)},
          {"plate", make_plate_with_hole(1, 0.02, 0.4)},
          {"two holes", make_plate_with_two_holes(0.2, 0.1)},
          {"capsule", make_capsule(0.2, 0.8, 12)},
          {"ellipsoid", turned(make_ellipsoid({0.6, 0.4, 0.2}, 14))},
          {"shell", make_shell(180, 80)},
          {"parts", make_two_parts(80)},
          {"tetrahedron", make_tetrahedron({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}})},
          {"large sphere", make_sphere(0.5, 600)}};
}

std::vector<Named> degenerate_meshes() {
  std::vector<Named> all = {{"needle", make_box({2, 0.01, 0.02}), true},
                            {"sliver", turned(make_sliver()), true},
                            {"film", turned(make_box({1, 1, 1e-7})), true},
                            {"box without a lid", without_its_first_triangles(make_box({1, 1, 1}), 2), true},
                            {"open sphere", without_its_first_triangles(make_sphere(0.5, 180), 25), true},
                            {"triangle", without_its_first_triangles(make_box({1, 1, 1}), 11), true}};
  for (std::uint64_t seed = 1; seed <= 2 * mutation_count(); ++seed) {
    Mutation mutation = make_mutation(seed);
    if (mutation.mesh.triangles.size() > 600) continue;
    all.push_back({std::move(mutation.description), std::move(mutation.mesh), true});
  }
  return all;
}

}  // namespace

BallSets grid_balls(const IndexedMesh& mesh, int cells) {
  const PreparedMesh& prepared = mesh.prepared();
  const reference::Tree tree(to_reference(prepared));
  const Point &lower = prepared.report.lower, &upper = prepared.report.upper;
  const double side = std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}) / cells;
  const double half_diagonal = std::sqrt(3.0) / 2 * side;
  const auto count_along = [&](std::size_t axis) {
    return std::max(1, static_cast<int>(std::ceil((upper[axis] - lower[axis]) / side)));
  };
  // Far more than the roundings of a centre and a distance.
  const double slack = 1e-9 * side + 16 * tree.rounding();
  BallSets sets;
  for (int i = 0; i < count_along(0); ++i) {
    for (int j = 0; j < count_along(1); ++j) {
      for (int k = 0; k < count_along(2); ++k) {
        const Point c = {lower[0] + (i + 0.5) * side, lower[1] + (j + 0.5) * side, lower[2] + (k + 0.5) * side};
        const Eigen::Vector3d centre = to_eigen(c);
        const double distance = tree.closest(centre).distance;
        const bool is_in = prepared.report.closed && reference::is_inside(tree, centre);
        if (is_in || distance <= half_diagonal + slack) sets.cover.push_back({c, half_diagonal + slack});
        if (is_in && distance > slack) sets.inside.push_back({c, distance - slack});
      }
    }
  }
  return sets;
}

DistanceSolid make_distance_solid(std::string name, const Mesh& mesh, bool is_degenerate, const BallMaker& balls) {
  Result<PreparedMesh> prepared = prepare_mesh(mesh);
  if (!prepared.ok()) throw std::runtime_error(name + ": " + prepared.error().message);
  const IndexedMesh of_mesh = indexed(prepared.value(), 1);
  const BallSets sets = balls(of_mesh);
  Result<Body> body = Body::create(of_mesh, sets.inside, sets.cover, {.threads = 1});
  if (!body.ok()) throw std::runtime_error(name + ": " + body.error().message);
  const MeshReport& report = of_mesh.prepared().report;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, report.upper[k] - report.lower[k]);
  return {std::move(name),
          is_degenerate,
          reference::DistanceMesh(to_reference(of_mesh.prepared())),
          std::move(body).value(),
          report.lower,
          report.upper,
          size};
}

std::vector<DistanceSolid> generated_distance_solids(const BallMaker& balls) {
  std::vector<DistanceSolid> solids;
  for (const Named& named : regular_meshes()) {
    solids.push_back(make_distance_solid(named.name, named.mesh, false, balls));
    // Small ones fit into the others.
    solids.push_back(make_distance_solid("small " + named.name, scaled(named.mesh, 0.05), false, balls));
  }
  const Mesh torus = make_torus(0.5, 0.2, 8, 12);
  solids.push_back(make_distance_solid("tiny torus", scaled(torus, 1e-6), false, balls));
  solids.push_back(make_distance_solid("huge torus", scaled(torus, 1e6), false, balls));
  solids.push_back(make_distance_solid("distant torus", moved(torus, {3e3, -2e3, 1e3}), false, balls));
  for (const Named& named : degenerate_meshes()) {
    try {
      solids.push_back(make_distance_solid(named.name, named.mesh, true, balls));
    } catch (const std::runtime_error&) {
      // Nothing is left of some mutations.
    }
  }
  return solids;
}

}  // namespace medial_vk::test
