#include "output/plane_picture/canvas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/colours/colour_map.h"

namespace medial_vk::picture {
namespace {

using Eigen::Vector3f;

/// The first and the last sample whose middle may lie between two places of one axis.
std::pair<std::uint32_t, std::uint32_t> samples_between(double from, double to, std::uint32_t count) {
  const double last = static_cast<double>(count);
  return {static_cast<std::uint32_t>(std::clamp(std::floor(from - 0.5), 0.0, last)),
          static_cast<std::uint32_t>(std::clamp(std::ceil(to + 0.5), 0.0, last))};
}

/// Squares of distances along one line from squared heights at its places (Felzenszwalb and Huttenlocher 2012).
void lower_parabolas(std::vector<float>& heights, std::vector<std::size_t>& places, std::vector<float>& starts) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const std::vector<float> given = heights;
  const auto height = [&](std::size_t i) { return given[i] + static_cast<float>(i) * static_cast<float>(i); };
  places.clear();
  starts.clear();
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] == kInfinite) continue;
    float start = -kInfinite;
    while (!places.empty()) {
      start = (height(i) - height(places.back())) / (2 * static_cast<float>(i - places.back()));
      if (start > starts.back()) break;
      places.pop_back();
      starts.pop_back();
      start = -kInfinite;
    }
    places.push_back(i);
    starts.push_back(start);
  }
  if (places.empty()) return;
  for (std::size_t i = 0, k = 0; i < given.size(); ++i) {
    while (k + 1 < places.size() && starts[k + 1] < static_cast<float>(i)) ++k;
    const float off = static_cast<float>(i) - static_cast<float>(places[k]);
    heights[i] = given[places[k]] + off * off;
  }
}

}  // namespace

Canvas::Canvas(std::uint32_t width, std::uint32_t height)
    : width_(width * kSamples), height_(height * kSamples), samples_(std::size_t{width_} * height_, Vector3f::Ones()) {}

void Canvas::blend(std::uint32_t x, std::uint32_t y, const Vector3f& colour, float opacity) {
  Vector3f& sample = samples_[std::size_t{y} * width_ + x];
  sample += opacity * (colour - sample);
}

template <class What>
void Canvas::for_each_near(const Spot& centre, double radius, const What& what) {
  const auto [left, right] = samples_between(centre[0] - radius, centre[0] + radius, width_);
  const auto [top, bottom] = samples_between(centre[1] - radius, centre[1] + radius, height_);
  for (std::uint32_t y = top; y < bottom; ++y) {
    for (std::uint32_t x = left; x < right; ++x) what(x, y, (Spot(x + 0.5, y + 0.5) - centre).norm());
  }
}

void Canvas::stroke(const Spot& a, const Spot& b, double radius, const std::function<Vector3f(double)>& colour) {
  const Spot along = b - a;
  const double square = along.squaredNorm();
  const auto [left, right] = samples_between(std::min(a[0], b[0]) - radius, std::max(a[0], b[0]) + radius, width_);
  const auto [top, bottom] = samples_between(std::min(a[1], b[1]) - radius, std::max(a[1], b[1]) + radius, height_);
  for (std::uint32_t y = top; y < bottom; ++y) {
    // Only what is near the line in this row: a long oblique stroke has a large box.
    auto [first, end] = std::pair(left, right);
    if (std::fabs(along[1]) > 1e-9) {
      const double middle = a[0] + along[0] * (y + 0.5 - a[1]) / along[1];
      const double reach = radius * std::sqrt(square) / std::fabs(along[1]);
      const auto [from, to] = samples_between(middle - reach, middle + reach, width_);
      first = std::max(first, from);
      end = std::min(end, to);
    }
    for (std::uint32_t x = first; x < end; ++x) {
      const Spot at(x + 0.5, y + 0.5);
      const double share = square > 0 ? std::clamp((at - a).dot(along) / square, 0.0, 1.0) : 0;
      if ((at - a - share * along).squaredNorm() > radius * radius) continue;
      samples_[std::size_t{y} * width_ + x] = colour(share);
    }
  }
}

void Canvas::disc(const Spot& centre, double radius, const Vector3f& colour, float opacity) {
  for_each_near(centre, radius, [&](std::uint32_t x, std::uint32_t y, double distance) {
    if (distance <= radius) blend(x, y, colour, opacity);
  });
}

void Canvas::circle(const Spot& centre, double radius, double width, const Vector3f& colour, float opacity) {
  for_each_near(centre, radius + width, [&](std::uint32_t x, std::uint32_t y, double distance) {
    if (std::fabs(distance - radius) <= width / 2) blend(x, y, colour, opacity);
  });
}

Picture Canvas::picture() const {
  Picture picture;
  picture.width = width_ / kSamples;
  picture.height = height_ / kSamples;
  picture.rgb.reserve(std::size_t{picture.width} * picture.height * 3);
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      Vector3f sum = Vector3f::Zero();
      for (std::uint32_t k = 0; k < kSamples * kSamples; ++k) {
        sum += samples_[(std::size_t{y} * kSamples + k / kSamples) * width_ + std::size_t{x} * kSamples + k % kSamples];
      }
      for (Eigen::Index channel = 0; channel < 3; ++channel) {
        picture.rgb.push_back(byte_of(sum[channel] / (kSamples * kSamples)));
      }
    }
  }
  return picture;
}

std::vector<bool> inside_of(std::span<const AreaEdge> edges, std::uint32_t width, std::uint32_t height) {
  std::vector<bool> is_inside(std::size_t{width} * height);
  for (const AreaEdge& edge : edges) {
    const auto [low, high] = std::minmax(edge.a[1], edge.b[1]);
    const auto [first, end] = samples_between(low, high, height);
    for (std::uint32_t y = first; y < end; ++y) {
      const double at = y + 0.5;
      if (at < low || at >= high) continue;  // half open, so that a ring crosses every row evenly often
      const double x = edge.a[0] + (edge.b[0] - edge.a[0]) * (at - edge.a[1]) / (edge.b[1] - edge.a[1]);
      if (x >= width) continue;
      const auto column = static_cast<std::uint32_t>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width)));
      if (column < width) is_inside[std::size_t{y} * width + column].flip();
    }
  }
  for (std::uint32_t y = 0; y < height; ++y) {
    bool is_in = false;
    for (std::uint32_t x = 0; x < width; ++x) {
      is_in = is_in != is_inside[std::size_t{y} * width + x];
      is_inside[std::size_t{y} * width + x] = is_in;
    }
  }
  return is_inside;
}

std::vector<float> depths_of(const std::vector<bool>& is_inside, std::uint32_t width, std::uint32_t height) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  std::vector<float> squares(is_inside.size());
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = is_inside[i] ? kInfinite : 0;
  std::vector<float> line, starts;
  std::vector<std::size_t> places;
  const auto sweep = [&](std::size_t first, std::size_t stride, std::size_t count) {
    line.resize(count);
    for (std::size_t i = 0; i < count; ++i) line[i] = squares[first + i * stride];
    lower_parabolas(line, places, starts);
    for (std::size_t i = 0; i < count; ++i) squares[first + i * stride] = line[i];
  };
  for (std::uint32_t x = 0; x < width; ++x) sweep(x, width, height);
  for (std::uint32_t y = 0; y < height; ++y) sweep(std::size_t{y} * width, 1, width);
  for (float& square : squares) square = std::sqrt(square);
  return squares;
}

}  // namespace medial_vk::picture
