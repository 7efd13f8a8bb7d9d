#include "geometry/corner_volume.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

/// A sum of doubles without rounding. Its parts do not overlap, and the least comes first: so the last one that is not
/// zero has the sign of the sum (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates", 1997, theorem 10).
class ExactSum {
 public:
  void add(double x) {
    for (double& part : parts_) {
      const double sum = part + x, of_x = sum - part;
      part = (part - (sum - of_x)) + (x - of_x);  // what the sum has lost
      x = sum;
    }
    parts_.push_back(x);
    std::erase(parts_, 0.0);
  }

  void add_product(double x, double y, double z) {
    const double xy = x * y;
    for (const double part : {xy, lost_by_rounding(x, y, xy)}) {
      const double product = part * z;
      add(product);
      add(lost_by_rounding(part, z, product));
    }
  }

  double value() const { return std::accumulate(parts_.begin(), parts_.end(), 0.0); }

 private:
  /// x y - product, where `product` is their rounded product.
  static double lost_by_rounding(double x, double y, double product) {
#if defined(_WIN32)  // where fma() rounds twice: by halves of numbers (Shewchuk 1997, theorem 18)
    const auto upper_half = [](double number) {
      const double scaled = 0x8000001p0 * number;
      return scaled - (scaled - number);
    };
    const double x_upper = upper_half(x), x_lower = x - x_upper, y_upper = upper_half(y), y_lower = y - y_upper;
    return x_lower * y_lower - (((product - x_upper * y_upper) - x_lower * y_upper) - x_upper * y_lower);
#else
    return std::fma(x, y, -product);
#endif
  }

  std::vector<double> parts_;
};

/// (b - a) x (c - a) . (d - a): the determinant of the corners with a column of ones, as a sum of products of three
/// coordinates, which are exact as long as none of their digits is below 2^-1074.
double exact_volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  ExactSum sum;
  const auto add_determinant = [&](const Vector3d& x, const Vector3d& y, const Vector3d& z) {
    for (int i = 0; i < 3; ++i) {
      sum.add_product(x[i], y[(i + 1) % 3], z[(i + 2) % 3]);
      sum.add_product(-x[i], y[(i + 2) % 3], z[(i + 1) % 3]);
    }
  };
  add_determinant(b, c, d);
  add_determinant(c, a, d);
  add_determinant(a, b, d);
  add_determinant(b, a, c);
  return sum.value();
}

}  // namespace

double corner_volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  using Long = long double;
  using LongVector = Eigen::Matrix<Long, 3, 1>;
  const LongVector from = a.cast<Long>(), x = b.cast<Long>() - from, y = c.cast<Long>() - from,
                   z = d.cast<Long>() - from;
  // Rounded, the volume has an error of less than 16 roundings of the product of the edges, and counts where it is more
  // than 2^24 of these.
  const Long rounded = x.cross(y).dot(z), error = 0x1p24L * 8 * std::numeric_limits<Long>::epsilon();
  const bool counts = rounded * rounded > error * error * x.squaredNorm() * y.squaredNorm() * z.squaredNorm();
  return counts ? static_cast<double>(rounded) : exact_volume(a, b, c, d);
}

}  // namespace medial_vk::reference
