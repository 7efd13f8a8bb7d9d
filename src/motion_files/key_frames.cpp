#include "motion_files/key_frames.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace medial_vk {
namespace {

/// Which of the three vectors of a key of a cubic spline.
enum Part : std::uint64_t { kBefore = 0, kValue = 1, kBehind = 2 };

const double* part_of_key(const KeyFrames& keys, std::uint64_t key, Part part) {
  const bool is_cubic = keys.interpolation == Interpolation::kCubic;
  return keys.values.values->data() + (is_cubic ? 3 * key + part : key) * keys.width;
}

/// Makes the length 1. A quaternion of length 0 is left as it is.
void normalize(double* q) {
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (norm > 0) {
    for (int k = 0; k < 4; ++k) q[k] /= norm;
  }
}

/// Between unit quaternions. The angle a between a and the nearer of b and -b is at most pi / 2; half of it is the
/// arctangent of |a - b| / |a + b|, which is accurate for small angles, too. The weights sin((1 - t) a) / sin(a) and
/// sin(t a) / sin(a) are accurate for every a > 0.
void interpolate_rotation(const std::array<double, 4>& a, const std::array<double, 4>& b, double t, double* values) {
  double product = 0;
  for (std::size_t k = 0; k < 4; ++k) product += a[k] * b[k];
  const double sign = product < 0 ? -1 : 1;
  double difference = 0, sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    difference += (a[k] - sign * b[k]) * (a[k] - sign * b[k]);
    sum += (a[k] + sign * b[k]) * (a[k] + sign * b[k]);
  }
  const double angle = 2 * std::atan2(std::sqrt(difference), std::sqrt(sum));
  if (!(std::sin(angle) > 0)) {  // equal, up to rounding and the sign
    std::copy(a.begin(), a.end(), values);
    return;
  }
  const double of_a = std::sin((1 - t) * angle) / std::sin(angle);
  const double of_b = sign * std::sin(t * angle) / std::sin(angle);
  for (std::size_t k = 0; k < 4; ++k) values[k] = of_a * a[k] + of_b * b[k];
}

/// A cubic Hermite spline (glTF 2.0, C.5): tangents are by second, and t is from 0 to 1.
void interpolate_cubic(const KeyFrames& keys, std::uint64_t key, double t, double seconds, double* values) {
  const double* from = part_of_key(keys, key, kValue);
  const double* leaving = part_of_key(keys, key, kBehind);
  const double* to = part_of_key(keys, key + 1, kValue);
  const double* arriving = part_of_key(keys, key + 1, kBefore);
  const double t2 = t * t, t3 = t2 * t;
  for (std::uint64_t k = 0; k < keys.width; ++k) {
    values[k] = (2 * t3 - 3 * t2 + 1) * from[k] + seconds * (t3 - 2 * t2 + t) * leaving[k] + (3 * t2 - 2 * t3) * to[k] +
                seconds * (t3 - t2) * arriving[k];
  }
  if (keys.is_rotation) normalize(values);
}

void interpolate_linear(const KeyFrames& keys, std::uint64_t key, double t, double* values) {
  const double* from = part_of_key(keys, key, kValue);
  const double* to = part_of_key(keys, key + 1, kValue);
  if (!keys.is_rotation) {
    for (std::uint64_t k = 0; k < keys.width; ++k) values[k] = (1 - t) * from[k] + t * to[k];
    return;
  }
  std::array<double, 4> a{}, b{};
  std::copy_n(from, 4, a.begin());
  std::copy_n(to, 4, b.begin());
  normalize(a.data());
  normalize(b.data());
  interpolate_rotation(a, b, t, values);
}

}  // namespace

void evaluate(const KeyFrames& keys, double time, double* values) {
  const double* first = keys.times.values->data();
  const double* const end = first + keys.times.count;
  const double* const next = std::upper_bound(first, end, time);
  const bool is_between = next != first && next != end;
  const auto key = static_cast<std::uint64_t>(next == first ? 0 : next - first - 1);
  if (is_between && keys.interpolation != Interpolation::kStep) {
    const double seconds = *next - next[-1];  // more than 0
    const double t = (time - next[-1]) / seconds;
    if (keys.interpolation == Interpolation::kLinear) return interpolate_linear(keys, key, t, values);
    return interpolate_cubic(keys, key, t, seconds, values);
  }
  std::copy_n(part_of_key(keys, key, kValue), keys.width, values);
  if (keys.is_rotation) normalize(values);
}

bool changes(const KeyFrames& keys) {
  const double* first = part_of_key(keys, 0, kValue);
  for (std::uint64_t key = 0; key < keys.times.count; ++key) {
    if (!std::equal(first, first + keys.width, part_of_key(keys, key, kValue))) return true;
    if (keys.interpolation != Interpolation::kCubic || keys.times.count == 1) continue;
    for (const Part part : {kBefore, kBehind}) {
      const double* tangent = part_of_key(keys, key, part);
      if (std::any_of(tangent, tangent + keys.width, [](double x) { return x != 0; })) return true;
    }
  }
  return false;
}

}  // namespace medial_vk
