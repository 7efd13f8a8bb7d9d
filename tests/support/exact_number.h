// Numbers with a finite binary expansion, exactly, by long integers: a deliberately simple oracle for exact predicates.
// Each is an integer of 4096 bits times a power of two; nothing checks for overflow.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace medial_vk::test {

class ExactNumber {
 public:
  ExactNumber() = default;
  ExactNumber(double a) {  // NOLINT: doubles are such numbers
    if (a == 0) return;
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(std::fabs(a), &exponent), 53));
    exponent_ = exponent - 53;
    limbs_[0] = static_cast<std::uint32_t>(mantissa);
    limbs_[1] = static_cast<std::uint32_t>(mantissa >> 32);
    if (a < 0) *this = -*this;
  }

  int sign() const {
    if (limbs_.back() >> 31 != 0) return -1;
    return std::all_of(limbs_.begin(), limbs_.end(), [](std::uint32_t limb) { return limb == 0; }) ? 0 : 1;
  }

  friend ExactNumber operator-(const ExactNumber& a) {
    ExactNumber result;
    result.exponent_ = a.exponent_;
    std::uint64_t carry = 1;
    for (std::size_t k = 0; k < kLimbs; ++k) {
      carry += static_cast<std::uint32_t>(~a.limbs_[k]);
      result.limbs_[k] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    return result;
  }
  friend ExactNumber operator+(ExactNumber a, ExactNumber b) {
    const int exponent = std::min(a.exponent_, b.exponent_);
    a.lower_exponent(exponent);
    b.lower_exponent(exponent);
    std::uint64_t carry = 0;
    for (std::size_t k = 0; k < kLimbs; ++k) {
      carry += std::uint64_t{a.limbs_[k]} + b.limbs_[k];
      a.limbs_[k] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    return a;
  }
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) { return a + -b; }
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
    ExactNumber result;  // two's complement: exact modulo 2^4096
    result.exponent_ = a.exponent_ + b.exponent_;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      if (a.limbs_[i] == 0) continue;
      std::uint64_t carry = 0;
      for (std::size_t j = 0; i + j < kLimbs; ++j) {
        carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + result.limbs_[i + j];
        result.limbs_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
    }
    return result;
  }

 private:
  static constexpr std::size_t kLimbs = 128;

  void lower_exponent(int exponent) {
    const auto shift = static_cast<std::size_t>(exponent_ - exponent);
    exponent_ = exponent;
    const std::size_t whole = shift / 32, bits = shift % 32;
    for (std::size_t k = kLimbs; k-- > 0;) {
      const std::uint64_t high = k >= whole ? limbs_[k - whole] : 0, low = k > whole ? limbs_[k - whole - 1] : 0;
      limbs_[k] = static_cast<std::uint32_t>((high << 32 | low) << bits >> 32);
    }
  }

  std::array<std::uint32_t, kLimbs> limbs_{};
  int exponent_ = 0;
};

/// det(a, b, c) of three rows.
template <class Row>
ExactNumber exact_determinant(const Row& a, const Row& b, const Row& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

}  // namespace medial_vk::test
