#include "support/solids/arrangements.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "base/point_ops.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

Mesh turned_parts(std::initializer_list<Mesh> parts) {
  Mesh all;
  for (const Mesh& part : parts) append(all, part);
  rotate(all, {0.3, 0.5, 0.8}, 0.7);
  return all;
}

/// A part turned about its own origin, then moved.
Mesh placed(Mesh part, const Point& axis, double angle, const Point& offset) {
  rotate(part, axis, angle);
  translate(part, offset);
  return part;
}

/// A square bar of this length about the z axis: as thin as a line.
Mesh bar(double length) { return moved(make_box({0.01, 0.01, length}), {-0.005, -0.005, -length / 2}); }

Mesh eight_spheres() {
  Mesh all;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.1}) {
      for (const double z : {0.0, 0.9}) append(all, moved(make_sphere(0.3, 80), {x, y, z}));
    }
  }
  rotate(all, {0.3, 0.5, 0.8}, 0.7);
  return all;
}

/// Links of a chain: each passes through the hole of the other.
Mesh two_rings() {
  return turned_parts(
      {make_torus(1, 0.2, 12, 32), placed(make_torus(1, 0.2, 12, 32), {1, 0, 0}, std::acos(0.0), {1, 0, 0})});
}

Mesh ball_in_shell() { return turned_parts({make_shell(320, 320), moved(make_sphere(0.25, 180), {0.2, 0.1, -0.15})}); }

}  // namespace

Mesh make_points(std::size_t count, double edge) {
  constexpr double kApart = 0.15;
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point> places;
  while (places.size() < count) {
    Point p;
    for (double& x : p) x = unit(engine);
    if (std::ranges::all_of(places, [&](const Point& q) { return length(p - q) > kApart; })) places.push_back(p);
  }
  Mesh all;
  const double h = edge / std::sqrt(8.0);
  for (const Point& p : places) {
    append(all, moved(make_tetrahedron({{{h, h, h}, {-h, h, -h}, {h, -h, -h}, {-h, -h, h}}}), p));
  }
  return all;
}

const std::vector<Arrangement>& arrangements() {
  static const std::vector<Arrangement> all = {
      {"two-boxes",
       [] {
         return turned_parts({make_box({1, 0.6, 0.3}), moved(make_box({0.8, 0.7, 0.4}), {0.1, -0.05, 0.5})});
       }},
      {"box-and-sphere",
       [] {
         return turned_parts({make_box({0.8, 0.5, 0.6}), moved(make_sphere(0.35, 320), {1.3, 0.2, 0.4})});
       }},
      {"three-lines",
       [] {
         return turned_parts({bar(2), placed(bar(2), {0.1, 1, 0}, 1.45, {0, 0.4, 0.3}),
                              placed(bar(2), {1, 0.1, 0}, 1.35, {0.35, 0, -0.35})});
       }},
      {"twelve-points", [] { return turned_parts({make_points(12, 0.002)}); }},
      {"two-rings", two_rings},
      {"ball-in-shell", ball_in_shell},
      {"cup-and-ball",
       [] {
         return turned_parts({make_cup(1, 0.25, 1.2, 32), moved(make_sphere(0.3, 180), {0.1, 0.2, 0.9})});
       }},
      {"eight-spheres", eight_spheres},
      {"l-and-box",
       [] {
         return turned_parts({make_l_shape(1, 0.35, 0.4), moved(make_box({0.4, 0.3, 0.7}), {0.5, 0.6, -0.1})});
       }},
      {"three-ellipsoids",
       [] {
         return turned_parts({make_ellipsoid({1, 0.6, 0.35}, 24),
                              placed(make_ellipsoid({0.5, 0.5, 0.2}, 20), {1, 1, 0}, 0.8, {0.9, 0.9, 0.4}),
                              placed(make_ellipsoid({0.7, 0.2, 0.2}, 20), {0, 1, 1}, 0.5, {-0.6, 0.3, 1.1})});
       }},
  };
  return all;
}

}  // namespace medial_vk::test
