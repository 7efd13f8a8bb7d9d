#include "output/boundary_colours/boundary_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "output/colours/colour_map.h"

namespace medial_vk {
namespace {

using Eigen::Vector3f;

const Vector3f kUnknownGrey(0.62f, 0.62f, 0.62f);
const Vector3f kNegative(0.13f, 0.40f, 0.67f), kZero(0.97f, 0.97f, 0.97f), kPositive(0.70f, 0.09f, 0.17f);

/// The hues of the six corners of the colour circle, from red by 60 degrees each; `corner` is 0 to 4.
Vector3f hue_at(double corner) {
  static constexpr std::array<std::array<float, 3>, 5> kCorners = {
      {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
  const std::size_t below = std::min(static_cast<std::size_t>(std::max(corner, 0.0)), kCorners.size() - 2);
  const auto share = static_cast<float>(corner - static_cast<double>(below));
  const Vector3f from(kCorners[below].data()), to(kCorners[below + 1].data());
  return from + share * (to - from);
}

Vector3f diverging(double share) {
  const auto part = static_cast<float>(std::clamp(std::abs(share), 0.0, 1.0));
  return kZero + part * ((share < 0 ? kNegative : kPositive) - kZero);
}

/// The 98th percentile of the magnitudes: single values at creases do not take all colours.
double usual_magnitude(std::span<const double> values) {
  std::vector<double> magnitudes;
  magnitudes.reserve(values.size());
  for (const double value : values) {
    if (!std::isnan(value)) magnitudes.push_back(std::abs(value));
  }
  if (magnitudes.empty()) return 1;
  const auto at = magnitudes.begin() + static_cast<std::ptrdiff_t>(98 * (magnitudes.size() - 1) / 100);
  std::ranges::nth_element(magnitudes, at);
  return *at > 0 ? *at : 1;
}

std::string with_grey(const std::string& title, const std::vector<Vector3f>& colours) {
  return std::ranges::find(colours, kUnknownGrey) == colours.end() ? title : title + ", grey: unknown";
}

BoundaryColours by_thickness(const BoundaryFields& fields) {
  const std::vector<double>& lower = fields.find(field_names::kThicknessLower)->values;
  const std::vector<double>& upper = fields.find(field_names::kThicknessUpper)->values;
  // Colours show lower ends, which are proved. Where no ball was found, little is known, but for thin places.
  const double greatest = lower.empty() ? 1 : std::max(*std::ranges::max_element(lower), 0.0);
  BoundaryColours out;
  out.of_vertices.reserve(lower.size());
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const bool is_known = lower[i] > 0 || upper[i] <= 0.01 * greatest;
    const double share = greatest > 0 ? lower[i] / greatest : 0;
    out.of_vertices.push_back(is_known ? picture::viridis(static_cast<float>(share)) : kUnknownGrey);
  }
  const auto samples = picture::viridis_samples();
  out.bar.assign(samples.begin(), samples.end());
  out.title = with_grey("thickness (units of the mesh)", out.of_vertices);
  out.least = "0";
  out.greatest = fmt::format("{:.3g}", greatest);
  return out;
}

BoundaryColours by_kappa(const BoundaryField& kappa, const char* name) {
  const double most = usual_magnitude(kappa.values);
  BoundaryColours out;
  out.of_vertices.reserve(kappa.values.size());
  for (const double value : kappa.values) {
    out.of_vertices.push_back(std::isnan(value) ? kUnknownGrey : diverging(value / most));
  }
  out.bar = {diverging(-1), diverging(0), diverging(1)};
  out.title = with_grey(fmt::format("{} (1 / unit of the mesh)", name), out.of_vertices);
  out.least = fmt::format("{:.3g}", -most);
  out.greatest = fmt::format("{:.3g}", most);
  return out;
}

BoundaryColours by_shape(const BoundaryFields& fields, double longest_side) {
  const std::vector<double>& kappa_1 = fields.find(field_names::kKappa1)->values;
  const std::vector<double>& kappa_2 = fields.find(field_names::kKappa2)->values;
  BoundaryColours out;
  out.of_vertices.reserve(kappa_1.size());
  for (std::size_t i = 0; i < kappa_1.size(); ++i) {
    const bool is_known = !std::isnan(kappa_1[i]) && !std::isnan(kappa_2[i]);
    out.of_vertices.push_back(is_known ? colour_of_shape(kappa_1[i], kappa_2[i], longest_side) : kUnknownGrey);
  }
  out.title = "shape";
  constexpr double kLarge = 1e9;  // Of fully saturated colours.
  out.swatches = {{colour_of_shape(kLarge, kLarge, 1), "convex"},    {colour_of_shape(kLarge, 0, 1), "outer cylinder"},
                  {colour_of_shape(kLarge, -kLarge, 1), "saddle"},   {colour_of_shape(0, -kLarge, 1), "inner cylinder"},
                  {colour_of_shape(-kLarge, -kLarge, 1), "concave"}, {colour_of_shape(0, 0, 1), "flat"}};
  if (std::ranges::find(out.of_vertices, kUnknownGrey) != out.of_vertices.end()) {
    out.swatches.emplace_back(kUnknownGrey, "unknown");
  }
  return out;
}

}  // namespace

// In the plane of both curvatures the five shapes lie at equal angles, from (1, 1), convex, by (1, 0), (1, -1) and
// (0, -1) to (-1, -1), concave: the hue is linear in the angle.
Vector3f colour_of_shape(double kappa_1, double kappa_2, double length) {
  const double size = std::hypot(kappa_1, kappa_2);
  if (!(size > 0)) return Vector3f::Ones();
  const double turned = std::clamp((kappa_1 + kappa_2) / (std::numbers::sqrt2 * size), -1.0, 1.0);
  const auto saturation = static_cast<float>(2 * std::numbers::inv_pi * std::atan(size * length));
  return Vector3f::Ones() + saturation * (hue_at(4 * std::acos(turned) * std::numbers::inv_pi) - Vector3f::Ones());
}

bool can_colour(const BoundaryFields& fields, BoundaryColour by) {
  const bool is_thickness = by == BoundaryColour::kThickness;
  return fields.find(is_thickness ? field_names::kThicknessLower : field_names::kKappa1) != nullptr;
}

BoundaryColours colour_boundary(const BoundaryFields& fields, BoundaryColour by, double longest_side) {
  switch (by) {
    case BoundaryColour::kThickness:
      return by_thickness(fields);
    case BoundaryColour::kKappa1:
      return by_kappa(*fields.find(field_names::kKappa1), "kappa 1");
    case BoundaryColour::kKappa2:
      return by_kappa(*fields.find(field_names::kKappa2), "kappa 2");
    case BoundaryColour::kShape:
      break;
  }
  return by_shape(fields, longest_side);
}

}  // namespace medial_vk
