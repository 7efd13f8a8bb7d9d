// The centre of a ball that holds given points and adds least to the columns.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "sphere_fits/cover/cover_column.h"

namespace medial_vk {

/// A column that other balls have: the ball adds what it has above them.
struct PaidColumn {
  Column column;
  double area, rest, paid;  // height and cost (over a unit of area) of the highest of others
};

/// The distance from `centre` to the farthest point.
double farthest_of(std::span<const Point> points, const Point& centre);

/// Tries centres one after the other; the radius is the least that holds all points.
class CentreSearch {
 public:
  /// The first centre is that of `most`, and no ball may leave it. `columns`: all whose elements are in `most`.
  CentreSearch(std::vector<Point> points, std::vector<PaidColumn> columns, double ease, const Ball& most);

  /// Takes the ball around this centre if it lowers the sum by a share of 1e-4. Returns whether it did.
  bool attempt(const Point& centre);
  /// Steps towards `aim` and along the axes, halved when none of them lowers the sum. Returns the best ball.
  Ball descend(const Point& aim, int halvings);

 private:
  /// For centres not farther than `shift` from `centre`: the points that may be the farthest, and the columns that the
  /// ball may rise above.
  struct Region {
    Point centre{};
    double shift = -1;
    std::vector<Point> points;
    std::vector<PaidColumn> columns;
  };
  void focus(double shift);
  bool step(const Point& aim, double length_of_step);
  double cost(std::span<const PaidColumn> columns, const Ball& ball, double enough) const;

  std::vector<Point> points_;
  std::vector<PaidColumn> columns_;
  double ease_;
  Ball most_, best_;
  double least_;
  Region region_;
};

}  // namespace medial_vk
