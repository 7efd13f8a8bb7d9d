// Curvature by finite differences of given spokes, Sections 5.4.1 to 5.4.3 of the source.
#pragma once

#include <Eigen/Core>
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
  /// Another measurement of a ball. Its difference from the chosen one, times `factor`, estimates the error of that.
  struct Other {
    Basis basis;
    double factor = 1;
  };
  /// The basis of a ball, and where there are balls those with the first step in the other three of its directions, and
  /// in the same direction with the least step.
  struct Bases {
    Basis chosen;
    std::array<Other, 4> others;
    std::size_t count = 0;  ///< Of the others.
  };

  Point normal_of(std::uint32_t ball) const;
  /// Its spokes, exchanged if its normal points away from `normal`.
  SpokePair aligned(std::uint32_t ball, const Point& normal) const;
  SpokePair average(const Point& place, double reach, const Point& normal, double least_cosine, bool& found) const;
  bool find_step(std::uint32_t ball, const Point& direction, double step, Neighbour& found) const;
  bool find_basis(std::uint32_t ball, Basis& basis) const;
  bool find_basis_along(const Point& direction, double step, std::uint32_t ball, const Point& normal,
                        Basis& basis) const;
  bool find_bases(std::uint32_t ball, Bases& bases) const;
  /// The radial shape operator of one spoke in the basis, -1 times its derivatives on the sheet along the spoke.
  static Eigen::Matrix2d radial_shape(const Basis& basis, const Point& spoke, const Point& at_first,
                                      const Point& at_second);
  /// Equation 5.14 with the other bases in the place of the truth; NaN if one of them fails the radial condition.
  double error_of(const Bases& bases, std::size_t side, const SpokePair& own, double radius) const;

  std::span<const Ball> balls_;
  std::vector<SpokePair> spokes_;
  std::vector<Point> centres_;
  double step_, least_step_;
  PointGrid grid_;
};

}  // namespace medial_vk
