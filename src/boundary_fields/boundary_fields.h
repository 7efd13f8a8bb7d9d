// What was measured at the vertices of the boundary, by name, for every file, picture and page that shows it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/thickness.h"
#include "medial_vk/vertex_curvature.h"

namespace medial_vk {

/// How a number is rounded where a file has fewer digits, so that an interval still holds what it held.
enum class FieldRounding : std::uint8_t { kNearest, kDown, kUp };

/// One quantity: `components` numbers for each vertex, 1 or 3. A number that is not known is NaN.
struct BoundaryField {
  std::string_view name;
  std::uint32_t components = 1;
  bool is_whole = false;  ///< All numbers are integers.
  FieldRounding rounding = FieldRounding::kNearest;
  std::vector<double> values = {};
};

struct BoundaryFields {
  std::vector<BoundaryField> of_vertices;
  std::vector<BoundaryField> of_balls;  ///< Of the ball at each vertex, for tables alone.

  /// Null: it was not measured.
  const BoundaryField* find(std::string_view name) const;
};

/// What the colours of the boundary show.
enum class BoundaryColour : std::uint8_t {
  kThickness,  ///< Viridis, from 0 to the greatest thickness.
  kKappa1,     ///< Blue where it is negative, white at 0, red where it is positive.
  kKappa2,     ///< As kKappa1.
  kShape,      ///< Hue by the ratio of both curvatures, pale where both are small (Figure 5-4).
};

namespace field_names {

inline constexpr std::string_view kThicknessLower = "thickness_lower", kThicknessUpper = "thickness_upper";
inline constexpr std::string_view kObjectAngle = "object_angle", kThicknessKind = "thickness_kind";
inline constexpr std::string_view kBallCentre = "ball_centre", kBallRadius = "ball_radius";
inline constexpr std::string_view kContactA = "contact_a", kContactB = "contact_b";
inline constexpr std::string_view kKappa1 = "kappa_1", kKappa2 = "kappa_2";
inline constexpr std::string_view kDirection1 = "direction_1", kDirection2 = "direction_2";
inline constexpr std::string_view kCurvatureError = "curvature_error", kCurvatureState = "curvature_state";
inline constexpr std::string_view kSheet = "sheet";

}  // namespace field_names

/// Adds both ends of the intervals, and the object angles and kinds of the balls that give the lower ends; `of_balls`
/// takes these balls with two contacts each.
void add_thickness(BoundaryFields& fields, std::span<const Thickness> of_vertices);

/// Adds curvatures, directions, errors, states, and the sheets of the balls that give them (-1: none).
void add_curvature(BoundaryFields& fields, std::span<const VertexCurvature> of_vertices,
                   std::span<const MedialSphere> spheres);

/// "none", "facets", "crease", "corner" or "wall".
std::string_view kind_name(ThicknessKind kind);
inline constexpr std::array<ThicknessKind, 5> kThicknessKinds = {
    ThicknessKind::kNone, ThicknessKind::kFacets, ThicknessKind::kCrease, ThicknessKind::kCorner, ThicknessKind::kWall};

/// "known", "cut" and so on: the words of the files for the numbers of a state.
std::string_view state_name(CurvatureState state);
inline constexpr std::size_t kCurvatureStates = 11, kTipStates = 10;  ///< Tips have all but the last one.

}  // namespace medial_vk
