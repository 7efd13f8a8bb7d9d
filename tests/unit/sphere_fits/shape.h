// Solids to which balls are fitted.
#pragma once

#include <utility>
#include <vector>

#include "medial_vk/ball_union.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_extractor.h"
#include "sphere_fits/methods/approximate.h"
#include "sphere_fits/methods/best_method.h"
#include "support/indexed.h"

namespace medial_vk {

/// A mesh that stays in memory, as its solid requires.
struct Shape {
  explicit Shape(Mesh raw)
      : mesh(prepare_mesh(std::move(raw)).value()), solid(Solid::build(test::indexed(mesh)).value()) {}
  Shape(const Shape&) = delete;

  Result<SphereSet> fit(const SphereFitOptions& request) const {
    return best_spheres(solid, request, reference_extractor(), {});
  }
  std::vector<SphereSet> balanced(std::size_t count, bool levels = false) const {
    SphereFitOptions request;
    request.contract = SphereContract::kBalanced;
    request.count = count;
    if (levels) return approximate_in_levels(solid, request, reference_extractor()).value();
    return {approximate_by_spheres(solid, request, reference_extractor()).value()};
  }
  double error_of(const std::vector<Ball>& balls) const {
    return 1 - measure_ball_union(balls).value().volume / solid.volume();
  }

  PreparedMesh mesh;
  Solid solid;
};

}  // namespace medial_vk
