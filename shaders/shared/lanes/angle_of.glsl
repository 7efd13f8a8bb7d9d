// The angle of a vector, for proofs that depend on it: Vulkan allows GLSL's atan an error of 4096 units in the last
// place. The series for |tan| <= tan(pi / 8) is from Cephes (S. L. Moshier, atanf), with an error below 2^-24 of the
// angle; with the quotient (2.5 units) and the other roundings the error is 8 u of the angle, u = 2^-24.
// tests/unit/shaders/angles_test.cpp compiles this file as C++.
#ifndef MEDIAL_VK_ANGLE_OF_GLSL
#define MEDIAL_VK_ANGLE_OF_GLSL

// From -pi to pi; 0 for the zero vector.
float angle_of(float x, float y) {
  float across = abs(x), up = abs(y);
  bool steep = up > across;
  float lesser = steep ? across : up, greater = steep ? up : across;
  bool large = lesser > 0.41421356f * greater;
  // tan(pi / 4 - a) = (1 - tan a) / (1 + tan a)
  float numerator = large ? greater - lesser : lesser;
  float denominator = large ? greater + lesser : greater;
  float t = numerator / max(denominator, 1e-30f);
  float s = t * t;
  float series =
      t - t * s * (0.333329491539f - s * (0.199777106478f - s * (0.138776856032f - s * 0.0805374449538f)));
  float angle = large ? 0.78539816f - series : series;
  angle = steep ? 1.57079633f - angle : angle;
  angle = x < 0.0f ? 3.14159265f - angle : angle;
  return y < 0.0f ? -angle : angle;
}

#endif
