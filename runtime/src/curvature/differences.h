// Curvature by finite differences of given spokes, Sections 5.4.1 to 5.4.3 of the source.
#pragma once

#include <span>
#include <vector>

#include "curvature/point_grid.h"
#include "medial_vk/curvature.h"

namespace medial_vk {

class SpokeDifferences {
 public:
  /// `spacing` is positive. Of the options, `step` and `smooth` count.
  SpokeDifferences(std::span<const Ball> balls, std::span<const SpokePair> spokes, double spacing,
                   const CurvatureOptions& options);

  /// One ball: both tips.
  BallCurvature measure(std::uint32_t ball) const;

 private:
  struct Neighbour {
    std::uint32_t ball;
    double length;  ///< Of the step to it.
  };
  struct Basis {
    Point first, second, normal;
    double length = 0;  ///< Of the step.
    SpokePair at_first, at_second;
  };

  Point normal_of(std::uint32_t ball) const;
  /// Its spokes, exchanged if its normal points away from `normal`.
  SpokePair aligned(std::uint32_t ball, const Point& normal) const;
  SpokePair average(const Point& place, double reach, const Point& normal, double least_cosine, bool& found) const;
  bool find_step(std::uint32_t ball, const Point& direction, double step, Neighbour& found) const;
  bool find_basis(std::uint32_t ball, Basis& basis) const;
  bool find_basis_with(double step, std::uint32_t ball, const Point& normal, Basis& basis) const;

  std::span<const Ball> balls_;
  std::vector<SpokePair> spokes_;
  std::vector<Point> centres_;
  double step_, least_step_;
  PointGrid grid_;
};

}  // namespace medial_vk
