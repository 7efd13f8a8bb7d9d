// The error-free transformations of the library (docs/theory.md) hold for operations that are rounded one by one. gcc
// joins a product and a sum into one fused operation unless it is told not to, where the processor has one: on 64-bit
// ARM always.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace medial_vk {
namespace {

// gcc fuses from -O2 on, and tests have less; clang does so always.
#ifdef __clang__
#define MEDIAL_VK_OPTIMISED [[gnu::noinline]]
#else
#define MEDIAL_VK_OPTIMISED [[gnu::noipa, gnu::optimize("O2")]]
#endif

MEDIAL_VK_OPTIMISED double product_less(double a, double b, double c) { return a * b - c; }
MEDIAL_VK_OPTIMISED float product_less(float a, float b, float c) { return a * b - c; }

MEDIAL_VK_OPTIMISED void products_less(const std::array<double, 8>& a, std::array<double, 8>& out, double c) {
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] * a[i] - c;
}

// (1 + e)^2 = 1 + 2e + e^2, of which rounding to nearest leaves 1 + 2e if e^2 is below half a unit in the last place.
TEST(Contraction, ProductsAreRoundedBeforeTheyAreSummed) {
  const double e = std::ldexp(1.0, -27);
  EXPECT_EQ(product_less(1 + e, 1 + e, 1 + 2 * e), 0);
  EXPECT_EQ(std::fma(1 + e, 1 + e, -(1 + 2 * e)), e * e) << "a fused operation is not rounded in between";
  const float f = std::ldexp(1.0F, -13);
  EXPECT_EQ(product_less(1 + f, 1 + f, 1 + 2 * f), 0);
}

TEST(Contraction, ProductsInLoopsAreRounded) {
  const double e = std::ldexp(1.0, -27);
  std::array<double, 8> a{};
  a.fill(1 + e);
  std::array<double, 8> out{};
  products_less(a, out, 1 + 2 * e);
  for (const double x : out) EXPECT_EQ(x, 0);
}

}  // namespace
}  // namespace medial_vk
