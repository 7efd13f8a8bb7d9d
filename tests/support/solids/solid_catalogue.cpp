#include "support/solids/solid_catalogue.h"

#include <utility>

#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

Mesh turned(Mesh mesh) {
  rotate(mesh, {0.3, 0.5, 0.8}, 0.7);
  return mesh;
}

}  // namespace

const std::vector<NamedSolid>& analytic_solids() {
  static const std::vector<NamedSolid> solids = {
      {"box",
       [] {
         return turned(make_box({1, 0.7, 0.5}));
       }},
      {"l-shape", [] { return turned(make_l_shape(1, 0.35, 0.4)); }},
      {"plate-with-hole", [] { return turned(make_plate_with_hole(1, 0.15, 0.4)); }},
      {"cup", [] { return turned(make_cup(1, 0.25, 1.2, 32)); }},
      {"sphere", [] { return turned(make_sphere(1, 2000)); }, true},
      {"capsule", [] { return turned(make_capsule(0.4, 1.5, 48)); }},
      {"oblate",
       [] {
         return turned(make_ellipsoid({1, 1, 0.4}, 60));
       }},
      {"prolate",
       [] {
         return turned(make_ellipsoid({1, 0.5, 0.5}, 60));
       }},
      {"triaxial",
       [] {
         return turned(make_ellipsoid({1, 0.6, 0.35}, 60));
       }},
      {"torus", [] { return turned(make_torus(1, 0.35, 32, 64)); }},
      {"flat-torus", [] { return turned(make_torus(1, 0.4, 32, 64, 0.5)); }},
  };
  return solids;
}

}  // namespace medial_vk::test
