// Sine, cosine and arcsine, as accurate as float allows, for proofs that depend on them: Vulkan allows the functions of
// GLSL an error of 5e-4. The series have a remainder below 2e-7 and few roundings: their error is below 1e-6
// (tests/unit/shaders/angles_test.cpp, which compiles this file as C++).
#ifndef MEDIAL_VK_ANGLES_GLSL
#define MEDIAL_VK_ANGLES_GLSL

// From -pi/2 to pi/2.
float sine(float x) {
  float s = x * x;
  float tail = 1.0f / 362880.0f - s * (1.0f / 39916800.0f);
  return x * (1.0f - s * (1.0f / 6.0f - s * (1.0f / 120.0f - s * (1.0f / 5040.0f - s * tail))));
}

// From 0 to pi.
float cosine(float x) { return sine(1.5707963f - x); }

// From 0 to 1. Above 1/2 by the half of the complementary angle: cos(a) = 1 - 2 sin(a / 2)^2.
float arcsine(float x) {
  bool large = x > 0.5f;
  float y = large ? sqrt(0.5f - 0.5f * x) : x;
  float s = y * y;
  float tail = 945.0f / 42240.0f + s * (10395.0f / 599040.0f + s * (135135.0f / 9676800.0f));
  float series =
      y * (1.0f + s * (1.0f / 6.0f + s * (3.0f / 40.0f + s * (15.0f / 336.0f + s * (105.0f / 3456.0f + s * tail)))));
  return large ? 1.5707963f - 2.0f * series : series;
}

#endif
