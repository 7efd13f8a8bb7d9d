// Balls whose union has its surface close to the boundary where it leaves the solid.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// What balls may reach out, as a share of the allowed depth: more would count as too deep.
inline constexpr double kReachShare = 7.0 / 8;

/// Keeps a union from reaching far out of the solid, and from filling gaps between its parts: where the boundary is too
/// deep in the union, a point outside the solid, close to it, becomes an *exposed point*, which no ball may hold from
/// then on (docs/theory.md, "Balanced", "Surfaces that stay close").
class NearBoundary {
 public:
  /// Keeps a reference to the solid. `most` is positive, in mesh units.
  NearBoundary(const Solid& solid, double most) : solid_(solid), most_(most) {}

  /// Balls that reach out by no more than kReachShare `most`, and no point of the boundary lies deeper in their union
  /// than `most`: these balls, some with smaller radii, which may be 0. Balls that lie in the solid remain as they are.
  /// Adds exposed points. Deterministic. Throws std::bad_alloc, Stopped, and std::runtime_error if depths cannot be
  /// computed as exactly as the bound requires.
  std::vector<Ball> keep(std::span<const Ball> balls, const Threads& threads);

  /// The greatest radius of a ball around this centre that reaches out by no more than kReachShare `most`, and holds no
  /// exposed point; not positive: there is none.
  double greatest_radius(const Point& centre) const;

 private:
  bool expose(const Point& deep, std::vector<Ball>& balls);
  Point cheapest_around(const Point& deep, std::span<const Ball> balls) const;

  const Solid& solid_;
  double most_;
  std::vector<Point> exposed_;
};

}  // namespace medial_vk
