// Numbers of twice the precision of double, for decisions that double leaves open, before exact arithmetic is needed.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

namespace medial_vk {

/// high + low == a + b, and high is the rounded sum (Knuth; Shewchuk 1997, theorem 7).
inline std::pair<double, double> two_sum(double a, double b) {
  const double high = a + b;
  const double of_b = high - a, of_a = high - of_b;
  return {high, (a - of_a) + (b - of_b)};
}

/// The same if |a| >= |b| or a == 0 (Dekker; Shewchuk 1997, theorem 6).
inline std::pair<double, double> fast_two_sum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

/// high + low == a, and neither has more than 26 digits (Veltkamp; Shewchuk 1997, theorem 17). Precondition: a is below
/// 2^996.
inline std::pair<double, double> halves(double a) {
  const double scaled = 0x8000001p0 * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

/// high + low == a b, and high is the rounded product, unless low underflows, by products without rounding (Dekker;
/// Shewchuk 1997, theorem 18). Precondition: a and b are below 2^996.
inline std::pair<double, double> two_product_of_halves(double a, double b) {
  const double high = a * b;
  const auto [a_high, a_low] = halves(a);
  const auto [b_high, b_low] = halves(b);
  return {high, a_low * b_low - (((high - a_high * b_high) - a_low * b_high) - a_high * b_low)};
}

/// The same by one rounding. The fma() of MinGW-w64 rounds twice.
inline std::pair<double, double> two_product(double a, double b) {
#if defined(_WIN32)
  return two_product_of_halves(a, b);
#else
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
#endif
}

/// A sum of two doubles that do not overlap, with an error bound: each operation adds less than 8 units of 2^-106 of
/// the sum of magnitudes (M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous error bounds for basic building
/// blocks of double-word arithmetic", 2017: 3 units, and 5, or 7 without fma), but nothing if one number is zero or
/// both are single doubles: sums and products of numbers with few digits, as of balls on a grid, are exact.
/// Precondition: no product is below 2^-900, where its last digits would underflow; callers multiply five multiples of
/// 2^-170 at most.
class DoubleDouble {
 public:
  DoubleDouble() = default;
  explicit DoubleDouble(double a) : high_(a), size_(std::fabs(a)) {}
  /// a - b, exactly.
  static DoubleDouble difference(double a, double b) {
    const auto [high, low] = two_sum(a, -b);
    return {high, low, std::fabs(high), 0};
  }

  /// -1, 0 or 1 if that is certain.
  std::optional<int> certain_sign() const {
    if (std::fabs(high_) > 0x1p-102 * error_) return high_ > 0 ? 1 : -1;
    return error_ == 0 ? std::optional(0) : std::nullopt;
  }

  /// The nearest double, and a bound of the distance of the true number from it.
  double value() const { return high_; }
  double error() const { return 0x1p-102 * error_ + 0x1p-53 * std::fabs(high_); }

  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high_, -a.low_, a.size_, a.error_}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const auto [high, high_rest] = two_sum(a.high_, b.high_);
    const auto [low, low_rest] = two_sum(a.low_, b.low_);
    const auto [top, middle] = fast_two_sum(high, high_rest + low);
    const auto [x, y] = fast_two_sum(top, low_rest + middle);
    const double size = a.size_ + b.size_;
    return {x, y, size, a.error_ + b.error_ + (is_exact(a, b) ? 0 : size)};
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const auto [high, low] = two_product(a.high_, b.high_);
#if defined(_WIN32)
    const double cross = a.high_ * b.low_ + a.low_ * b.high_;
#else
    const double cross = std::fma(a.high_, b.low_, a.low_ * b.high_);
#endif
    const auto [x, y] = fast_two_sum(high, low + cross);
    const double size = a.size_ * b.size_;
    return {x, y, size, a.error_ * b.size_ + b.error_ * a.size_ + (is_exact(a, b) ? 0 : size)};
  }

 private:
  DoubleDouble(double high, double low, double size, double error)
      : high_(high), low_(low), size_(size), error_(error) {}

  /// True for a sum and for a product without rounding.
  static bool is_exact(const DoubleDouble& a, const DoubleDouble& b) {
    return (a.low_ == 0 && b.low_ == 0) || a.high_ == 0 || b.high_ == 0;
  }

  double high_ = 0, low_ = 0;
  double size_ = 0;   // at least the magnitude of the number, and of all terms of the sums that made it
  double error_ = 0;  // in units of 2^-103, without the roundings of size_ and error_, which certain_sign() allows for
};

}  // namespace medial_vk
