// Statistics of numbers, and the errors of one method of measuring curvature, as a row of a table.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "smooth_boundaries.h"

namespace medial_vk::bench {

double degrees_between(const Point& a, const Point& b);

class Numbers {
 public:
  void add(double value) { values_.push_back(value); }
  std::size_t count() const { return values_.size(); }
  double mean() const;
  double deviation() const;  ///< The standard one.
  double quantile(double share);

 private:
  std::vector<double> values_;
};

/// The unit of errors of curvatures at a point: the greater one there, or a tenth of the solid's greatest.
double error_scale(const SmoothPoint& truth, double greatest);

/// The errors of one method on one solid.
class Errors {
 public:
  explicit Errors(double greatest) : greatest_(greatest) {}

  void add_unknown() { ++unknown_; }
  void add(const SmoothPoint& truth, const Point& normal, const std::array<double, 2>& kappa, const Point& direction,
           double estimate);
  void print(const std::string& solid, const std::string& method);

 private:
  double greatest_;
  std::size_t known_ = 0, unknown_ = 0, below_ = 0;
  std::array<Numbers, 2> kappas_;
  Numbers directions_, normals_, estimates_;
};

}  // namespace medial_vk::bench
