// Samples of a picture in the plane, and strokes, discs and areas on it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "output/picture/panels/image.h"

namespace medial_vk::picture {

using Spot = Eigen::Vector2d;  ///< In samples, y down.

/// kSamples x kSamples samples for each pixel, in sRGB.
class Canvas {
 public:
  static constexpr std::uint32_t kSamples = 2;

  Canvas(std::uint32_t width, std::uint32_t height);

  std::uint32_t width() const { return width_; }    ///< In samples.
  std::uint32_t height() const { return height_; }  ///< In samples.

  /// Blends a colour over a sample.
  void blend(std::uint32_t x, std::uint32_t y, const Eigen::Vector3f& colour, float opacity);
  /// A stroke with round ends. `colour(share)` is that of its points, from a, 0, to b, 1.
  void stroke(const Spot& a, const Spot& b, double radius, const std::function<Eigen::Vector3f(double)>& colour);
  void disc(const Spot& centre, double radius, const Eigen::Vector3f& colour, float opacity);
  void circle(const Spot& centre, double radius, double width, const Eigen::Vector3f& colour, float opacity);

  /// The means of the samples of each pixel.
  Picture picture() const;

 private:
  /// Calls what(x, y, distance from the centre) for samples around a disc.
  template <class What>
  void for_each_near(const Spot& centre, double radius, const What& what);

  std::uint32_t width_, height_;
  std::vector<Eigen::Vector3f> samples_;
};

/// An edge of an area.
struct AreaEdge {
  Spot a, b;
};

/// For each sample whether it lies inside of closed rings of edges, of which an odd number is to its left.
std::vector<bool> inside_of(std::span<const AreaEdge> edges, std::uint32_t width, std::uint32_t height);

/// For each sample that is inside its distance, in samples, from the nearest one that is not; 0 for all others. The
/// edge of the picture does not count.
std::vector<float> depths_of(const std::vector<bool>& is_inside, std::uint32_t width, std::uint32_t height);

}  // namespace medial_vk::picture
