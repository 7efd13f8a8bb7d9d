// Trigonometry of the kernels, compiled as C++: the proofs that depend on it allow errors of 1e-6 to 1e-5.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace medial_vk {
namespace {

namespace gpu_angles {
using std::sqrt;
#include "lanes/angles.glsl"
}  // namespace gpu_angles

constexpr int kSteps = 200000;
constexpr double kError = 1e-6;  // the bound stated in angles.glsl

TEST(Angles, SineIsRight) {
  for (int i = -kSteps; i <= kSteps; ++i) {
    const auto x = static_cast<float>(i * (std::numbers::pi / 2 / kSteps));
    ASSERT_NEAR(gpu_angles::sine(x), std::sin(double{x}), kError) << x;
  }
}

TEST(Angles, CosineIsRight) {
  for (int i = 0; i <= kSteps; ++i) {
    const auto x = static_cast<float>(i * (std::numbers::pi / kSteps));
    ASSERT_NEAR(gpu_angles::cosine(x), std::cos(double{x}), kError) << x;
  }
}

TEST(Angles, ArcsineIsRight) {
  for (int i = 0; i <= kSteps; ++i) {
    const auto x = static_cast<float>(i * (1.0 / kSteps));
    ASSERT_NEAR(gpu_angles::arcsine(x), std::asin(double{x}), kError) << x;
  }
  // The arcsine is steepest here.
  for (float x = 1; x > 0.999f; x = std::nextafter(x, 0.0f))
    ASSERT_NEAR(gpu_angles::arcsine(x), std::asin(double{x}), kError) << x;
}

}  // namespace
}  // namespace medial_vk
