// Expansions and numbers of twice the precision against long integers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "base/double_double.h"
#include "base/expansion.h"
#include "support/exact_number.h"

namespace medial_vk {
namespace {

using test::ExactNumber;

ExactNumber exact(Expansion e) {
  ExactNumber sum;
  for (const double component : e) sum = sum + component;
  return sum;
}

/// Expects components without zeros, in ascending order, of which no two have a bit in common.
void expect_well_formed(Expansion e) {
  for (std::size_t k = 0; k < e.size(); ++k) {
    ASSERT_NE(e[k], 0);
    if (k + 1 == e.size()) continue;
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(std::fabs(e[k + 1]), &exponent), 53));
    const double lowest_bit = std::ldexp(static_cast<double>(mantissa & -mantissa), exponent - 53);
    EXPECT_LT(std::fabs(e[k]), lowest_bit);
  }
}

class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : engine_(seed) {}
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  /// Short and long mantissas, both signs, zero, exponents over a range.
  double number(int exponents) {
    const int bits = 1 + below(53);
    const double mantissa = static_cast<double>(static_cast<std::int64_t>(engine_() >> (64 - bits)));
    return std::ldexp(below(2) != 0 ? mantissa : -mantissa, below(2 * exponents + 1) - exponents - bits);
  }

 private:
  std::mt19937_64 engine_;
};

/// An expression of random operations on random numbers, in both arithmetics.
std::pair<Expansion, ExactNumber> expression(RandomNumbers& random, ExpansionMath& math, int depth) {
  if (depth == 0) {
    const double a = random.number(40), b = random.number(40);
    switch (random.below(3)) {
      case 0:
        return {math.number(a), a};
      case 1:
        return {math.difference(a, b), ExactNumber(a) - b};
      default:
        return {math.square(a), ExactNumber(a) * a};
    }
  }
  const auto [e, x] = expression(random, math, random.below(depth));
  const auto [f, y] = expression(random, math, random.below(depth));
  switch (random.below(3)) {
    case 0:
      return {math.sum(e, f), x + y};
    case 1:
      return {math.difference(e, f), x - y};
    default:
      return {math.product(e, f), x * y};
  }
}

TEST(TwoProduct, LosesNothing) {
  RandomNumbers random(7);
  for (int i = 0; i < 20'000; ++i) {
    const double a = random.number(200);
    const double b = random.number(200);
    for (const auto& [high, low] : {two_product(a, b), two_product_of_halves(a, b)}) {
      ASSERT_EQ(high, a * b);
      ASSERT_EQ((ExactNumber(a) * b - high - low).sign(), 0) << a << ' ' << b;
    }
  }
}

TEST(Expansion, IsExact) {
  ExpansionArena arena;
  ExpansionMath math(arena);
  RandomNumbers random(1);
  for (int n = 0; n < 3000; ++n) {
    arena.reset();
    const auto [e, x] = expression(random, math, random.below(5));
    ASSERT_EQ((exact(e) - x).sign(), 0) << n;
    ASSERT_EQ(sign(e), x.sign()) << n;
    expect_well_formed(e);
  }
}

TEST(Expansion, CancelsToNothing) {
  ExpansionArena arena;
  ExpansionMath math(arena);
  RandomNumbers random(2);
  for (int n = 0; n < 500; ++n) {
    arena.reset();
    const Expansion a = expression(random, math, 2).first, b = expression(random, math, 2).first;
    EXPECT_TRUE(math.difference(a, a).empty());
    EXPECT_TRUE(math.sum(a, math.difference(Expansion{}, a)).empty());
    // (a + b)(a - b) - (a a - b b)
    const Expansion one = math.product(math.sum(a, b), math.difference(a, b));
    const Expansion other = math.difference(math.product(a, a), math.product(b, b));
    EXPECT_TRUE(math.difference(one, other).empty());
    EXPECT_TRUE(math.product(a, Expansion{}).empty());
  }
}

/// One unit in the last place of a number of 200 digits decides.
TEST(Expansion, SeesTheLastBit) {
  ExpansionArena arena;
  ExpansionMath math(arena);
  Expansion number = math.number(1);
  for (int k = 1; k < 12; ++k) number = math.sum(number, math.number(std::ldexp(1.0, -60 * k)));
  const Expansion more = math.sum(number, math.number(0x1p-700));
  EXPECT_EQ(sign(math.difference(more, number)), 1);
  EXPECT_EQ(sign(math.difference(number, more)), -1);
  EXPECT_EQ(number.size(), 12u);
}

TEST(Expansion, TakesMoreMemoryThanABlock) {
  ExpansionArena arena;
  for (int round = 0; round < 3; ++round) {
    arena.reset();
    double* first = arena.take(10);
    first[9] = 7;
    double* large = arena.take(100000);
    large[99999] = 8;
    double* last = arena.take(4000);
    last[3999] = 9;
    EXPECT_EQ(first[9] + large[99999] + last[3999], 24);
  }
}

/// A result reported as certain is right; a result far from zero always is certain.
TEST(DoubleDouble, IsNeverWronglyCertain) {
  RandomNumbers random(3);
  int certain = 0, near = 0;
  for (int n = 0; n < 5000; ++n) {
    // A 3 x 3 determinant whose last row is nearly a combination of the others.
    std::vector<double> m(9);
    for (double& x : m) x = random.number(3);
    const double s = random.number(3), t = random.number(3);
    for (std::size_t k = 0; k < 3; ++k) m[6 + k] = s * m[k] + t * m[3 + k];
    if (n % 2 != 0) m[6] += std::ldexp(random.number(0), -60 - random.below(60));
    const auto in = [&](auto number) {
      using Number = decltype(number);
      std::vector<Number> x;
      x.reserve(m.size());
      for (const double a : m) x.push_back(Number(a));
      const auto minor = [&](std::size_t u, std::size_t v) { return x[3 + u] * x[6 + v] - x[3 + v] * x[6 + u]; };
      return x[0] * minor(1, 2) + x[1] * minor(2, 0) + x[2] * minor(0, 1);
    };
    const auto found = in(DoubleDouble()).certain_sign();
    const int truth = in(ExactNumber()).sign();
    if (found) {
      ASSERT_EQ(*found, truth) << n;
    }
    certain += found.has_value();
    near += truth != 0;
  }
  EXPECT_GT(certain, near / 4);  // it is useful
}

/// Numbers with few digits lose nothing, so that ties of balls on a grid need no longer arithmetic.
TEST(DoubleDouble, ZeroIsCertainForNumbersWithFewDigits) {
  RandomNumbers random(5);
  for (int n = 0; n < 1000; ++n) {
    const auto digits = [&] { return DoubleDouble(static_cast<double>(random.below(2001)) - 1000); };
    const DoubleDouble a = digits(), b = digits(), c = digits(), s = digits();
    // The second row is a multiple of the first.
    const auto sign = (a * (b * s) - b * (a * s) + c * (a * (b * s) - b * (a * s))).certain_sign();
    ASSERT_TRUE(sign.has_value());
    EXPECT_EQ(*sign, 0);
  }
}

TEST(DoubleDouble, DifferencesAndProductsOfTwoDoublesAreCertain) {
  RandomNumbers random(4);
  for (int n = 0; n < 10000; ++n) {
    const double a = random.number(20), b = n % 2 != 0 ? random.number(20) : std::nextafter(a, 1.0);
    EXPECT_EQ(DoubleDouble::difference(a, b).certain_sign().value_or(0), a > b ? 1 : a < b ? -1 : 0);
    // a (b + 1 / 2^80) - a b: 27 bits below the last of a double.
    const double tiny = std::ldexp(b, -80);
    const DoubleDouble more =
        DoubleDouble(a) * (DoubleDouble(b) + DoubleDouble(tiny)) - DoubleDouble(a) * DoubleDouble(b);
    const int truth = a * tiny > 0 ? 1 : a * tiny < 0 ? -1 : 0;
    EXPECT_EQ(more.certain_sign().value_or(0), truth);
  }
}

}  // namespace
}  // namespace medial_vk
