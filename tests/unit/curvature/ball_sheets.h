// Medial balls of solids that are known in closed form, scattered over their sheets.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/curvature.h"

namespace medial_vk::test {

/// Balls with their exact spokes.
struct BallSheet {
  std::vector<Ball> balls;
  std::vector<SpokePair> spokes;

  void add(const Point& centre, double radius, const Point& a, const Point& b) {
    balls.push_back({centre, radius});
    spokes.push_back({a, b});
  }
};

/// Calls place(u, v) for one random point in each cell of a square grid of `spacing` over [-u, u] x [-v, v].
inline void scatter(double u, double v, double spacing, const std::function<void(double, double)>& place) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> share(0, 1);
  for (double x = -u; x < u; x += spacing) {
    for (double y = -v; y < v; y += spacing) {
      const double along_y = share(random), along_x = share(random);  // in one order, which arguments do not have
      place(x + along_x * spacing, y + along_y * spacing);
    }
  }
}

/// The spheroid of semi-axes a > c, c along z: a disc of balls in the plane z = 0. With e = a^2 - c^2 the ball at the
/// distance p from the middle has the radius c sqrt(1 - p^2 / e) and touches at p a^2 / e.
inline BallSheet spheroid(double a, double c, double spacing) {
  BallSheet out;
  const double e = a * a - c * c, rim = e / a;
  scatter(rim, rim, spacing, [&](double x, double y) {
    const double square = x * x + y * y;
    if (square > 0.96 * rim * rim) return;
    const double r = c * std::sqrt(1 - square / e), z = c * std::sqrt(1 - square * a * a / (e * e));
    const double out_by = a * a / e - 1;
    out.add({x, y, 0}, r, {out_by * x / r, out_by * y / r, z / r}, {out_by * x / r, out_by * y / r, -z / r});
  });
  return out;
}

/// Principal curvatures of that spheroid where the ball at the distance p touches: along the meridian and across it.
inline std::array<double, 2> spheroid_curvatures(double a, double c, double p) {
  const double sine = p * a / (a * a - c * c);  // of the parameter of the ellipse (a sin t, c cos t)
  const double speed = std::sqrt(a * a * (1 - sine * sine) + c * c * sine * sine);
  const std::array<double, 2> out = {a * c / (speed * speed * speed), c / (a * speed)};
  return {std::max(out[0], out[1]), std::min(out[0], out[1])};
}

/// A part of a pipe around z with the wall from `inner` to `outer`. Spoke a points outwards.
inline BallSheet pipe_wall(double inner, double outer, double spacing) {
  BallSheet out;
  const double middle = (inner + outer) / 2, r = (outer - inner) / 2;
  scatter(0.6 * middle, 0.6 * middle, spacing, [&](double along, double z) {
    const Point radial = {std::cos(along / middle), std::sin(along / middle), 0};
    out.add(middle * radial + Point{0, 0, z}, r, radial, -1 * radial);
  });
  return out;
}

/// Balls of radius `r` in a plane with the unit normal `normal` through the origin.
inline BallSheet flat_plate(const Point& normal, double side, double r, double spacing) {
  BallSheet out;
  const Point x = perpendicular_to(normal), y = cross(normal, x);
  scatter(side / 2, side / 2, spacing, [&](double u, double v) { out.add(u * x + v * y, r, normal, -1 * normal); });
  return out;
}

}  // namespace medial_vk::test
