// Least squares fits of polynomials in two variables, by the moments of their places.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace medial_vk {

/// The number of monomials up to a degree.
constexpr int terms_of(int degree) { return (degree + 1) * (degree + 2) / 2; }

/// The monomials by degree, then by the power of y: 1, x, y, x^2, xy, y^2, ...
constexpr std::size_t term_of(int power_x, int power_y) {
  const auto x = static_cast<std::size_t>(power_x), y = static_cast<std::size_t>(power_y);
  return (x + y) * (x + y + 1) / 2 + y;
}

/// All monomials up to a degree at a place.
template <int Degree>
std::array<double, terms_of(Degree)> monomials_at(double x, double y) {
  std::array<double, terms_of(Degree)> out;
  out[0] = 1;
  std::size_t at = 1;
  for (std::size_t degree = 1; degree <= Degree; ++degree) {
    for (std::size_t k = 0; k < degree; ++k, ++at) out[at] = x * out[at - degree];
    out[at] = y * out[at - degree - 1];
    ++at;
  }
  return out;
}

/// Sums over weighted places. The entries of the matrices of both kinds of normal equations, for the values and for the
/// slopes of a polynomial of this degree, are moments up to twice the degree, and a place costs no more than these.
/// Coordinates are to be of magnitude 1: for places all around the matrices then have a condition below 10^6, so that
/// coefficients keep half of the digits of a double.
template <int Degree>
class Moments {
 public:
  static constexpr int kTerms = terms_of(Degree);
  using Matrix = Eigen::Matrix<double, kTerms, kTerms>;
  using Vector = Eigen::Matrix<double, kTerms, 1>;
  using Monomials = std::array<double, terms_of(2 * Degree)>;

  /// Of the monomials of a place, up to twice the degree.
  void add(const Monomials& monomials, double weight) {
    for (std::size_t i = 0; i < monomials.size(); ++i) sums_[i] += weight * monomials[i];
  }
  double weights() const { return sums_[0]; }

  Matrix matrix_of_values() const {
    return fill([&](int ax, int ay, int bx, int by) { return sums_[term_of(ax + bx, ay + by)]; });
  }
  Matrix matrix_of_slopes() const {
    return fill([&](int ax, int ay, int bx, int by) {
      double sum = 0;
      if (ax > 0 && bx > 0) sum += ax * bx * sums_[term_of(ax + bx - 2, ay + by)];
      if (ay > 0 && by > 0) sum += ay * by * sums_[term_of(ax + bx, ay + by - 2)];
      return sum;
    });
  }

 private:
  template <class Entry>
  static Matrix fill(const Entry& entry) {
    Matrix out;
    for (int a = 0, row = 0; a <= Degree; ++a) {
      for (int ay = 0; ay <= a; ++ay, ++row) {
        for (int b = 0, column = 0; b <= Degree; ++b) {
          for (int by = 0; by <= b; ++by, ++column) out(row, column) = entry(a - ay, ay, b - by, by);
        }
      }
    }
    return out;
  }

  Monomials sums_ = {};
};

/// The products of the monomials up to a degree with a number of each place.
template <int Degree>
class RightSide {
 public:
  template <std::size_t Size>
  void add(const std::array<double, Size>& monomials, double weighted) {
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += weighted * monomials[i];
  }
  double operator[](std::size_t term) const { return sums_[term]; }
  Eigen::Matrix<double, terms_of(Degree), 1> vector() const {
    return Eigen::Map<const Eigen::Matrix<double, terms_of(Degree), 1>>(sums_.data());
  }

 private:
  std::array<double, static_cast<std::size_t>(terms_of(Degree))> sums_ = {};
};

/// Symmetric positive equations, by Cholesky's factors.
template <int Terms>
class NormalEquations {
 public:
  using Matrix = Eigen::Matrix<double, Terms, Terms>;
  using Vector = Eigen::Matrix<double, Terms, 1>;

  /// Reads the lower triangle. False if the places do not determine the polynomial: if a term is a combination of those
  /// before it but for 10^-9 of its square.
  bool factor(const Matrix& matrix) {
    for (int j = 0; j < Terms; ++j) {
      for (int i = j; i < Terms; ++i) {
        double sum = matrix(i, j);
        for (int k = 0; k < j; ++k) sum -= lower_(i, k) * lower_(j, k);
        if (i == j) {
          if (!(sum > 1e-9 * matrix(j, j))) return false;
          lower_(j, j) = std::sqrt(sum);
        } else {
          lower_(i, j) = sum / lower_(j, j);
        }
      }
    }
    return true;
  }
  Vector solve(Vector right) const {
    for (int i = 0; i < Terms; ++i) {
      for (int k = 0; k < i; ++k) right[i] -= lower_(i, k) * right[k];
      right[i] /= lower_(i, i);
    }
    for (int i = Terms - 1; i >= 0; --i) {
      for (int k = i + 1; k < Terms; ++k) right[i] -= lower_(k, i) * right[k];
      right[i] /= lower_(i, i);
    }
    return right;
  }
  /// Of the inverse: the variance of a coefficient for residuals of variance 1.
  double inverse_diagonal(int term) const { return solve(Vector::Unit(term))[term]; }

 private:
  Eigen::Matrix<double, Terms, Terms, Eigen::RowMajor> lower_;
};

}  // namespace medial_vk
