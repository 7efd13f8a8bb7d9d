#include "picture/perceptual.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "output/colours/colour_map.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#ifndef __clang_analyzer__
#define STB_IMAGE_IMPLEMENTATION
#endif
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace medial_vk::test {
namespace {

using Eigen::Vector3f;

float lab_curve(float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116.0f; }

/// White is that of sRGB (D65).
Vector3f to_lab(const Vector3f& light) {
  const float x = light.dot(Vector3f(0.4124f, 0.3576f, 0.1805f)) / 0.9505f;
  const float y = light.dot(Vector3f(0.2126f, 0.7152f, 0.0722f));
  const float z = light.dot(Vector3f(0.0193f, 0.1192f, 0.9505f)) / 1.0890f;
  return {116 * lab_curve(y) - 16, 500 * (lab_curve(x) - lab_curve(y)), 200 * (lab_curve(y) - lab_curve(z))};
}

/// The mean light of the 5 x 5 pixels around one, within the picture.
Vector3f blurred(const std::vector<Vector3f>& light, int width, int height, int x, int y) {
  Vector3f sum = Vector3f::Zero();
  float count = 0;
  for (int v = std::max(y - 2, 0); v <= std::min(y + 2, height - 1); ++v) {
    for (int u = std::max(x - 2, 0); u <= std::min(x + 2, width - 1); ++u, ++count) {
      sum += light[static_cast<std::size_t>(v * width + u)];
    }
  }
  return sum / count;
}

std::vector<Vector3f> lab_of(const Picture& picture) {
  std::vector<Vector3f> light, lab;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    light.push_back(picture::to_light(Vector3f(picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]) / 255.0f));
  }
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) lab.push_back(to_lab(blurred(light, width, height, x, y)));
  }
  return lab;
}

}  // namespace

LookDifference look_difference(const Picture& a, const Picture& b) {
  const std::vector<Vector3f> lab_a = lab_of(a), lab_b = lab_of(b);
  std::vector<double> differences;
  LookDifference out;
  for (std::size_t i = 0; i < lab_a.size(); ++i) {
    differences.push_back((lab_a[i] - lab_b[i]).norm());
    out.mean += differences.back() / static_cast<double>(lab_a.size());
  }
  const auto nth = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 100);
  std::nth_element(differences.begin(), nth, differences.end(), std::greater<>());
  out.worst = *nth;
  return out;
}

Result<Picture> read_png(const std::string& path) {
  int width = 0, height = 0, channels = 0;
  stbi_uc* bytes = stbi_load(path.c_str(), &width, &height, &channels, 3);
  if (bytes == nullptr) return Error{ErrorCode::kInternal, path + ": " + stbi_failure_reason()};
  Picture out;
  out.width = static_cast<std::uint32_t>(width);
  out.height = static_cast<std::uint32_t>(height);
  out.rgb.assign(bytes, bytes + std::size_t{3} * out.width * out.height);
  stbi_image_free(bytes);
  return out;
}

}  // namespace medial_vk::test
