#include "boundary_fields/boundary_fields.h"

#include <algorithm>
#include <array>
#include <utility>

namespace medial_vk {
namespace {

/// A field of one number for each of `items`.
template <class Item, class Value>
BoundaryField numbers(std::string_view name, std::span<const Item> items, const Value& value) {
  BoundaryField field = {.name = name};
  field.values.reserve(items.size());
  for (const Item& item : items) field.values.push_back(value(item));
  return field;
}

template <class Item, class Value>
BoundaryField vectors(std::string_view name, std::span<const Item> items, const Value& value) {
  BoundaryField field = {.name = name, .components = 3};
  field.values.reserve(3 * items.size());
  for (const Item& item : items) {
    const Point& vector = value(item);
    field.values.insert(field.values.end(), vector.begin(), vector.end());
  }
  return field;
}

}  // namespace

const BoundaryField* BoundaryFields::find(std::string_view name) const {
  const auto found = std::ranges::find(of_vertices, name, &BoundaryField::name);
  return found == of_vertices.end() ? nullptr : &*found;
}

void add_thickness(BoundaryFields& fields, std::span<const Thickness> of_vertices) {
  BoundaryField lower =
      numbers(field_names::kThicknessLower, of_vertices, [](const Thickness& t) { return t.diameter.lower; });
  lower.rounding = FieldRounding::kDown;
  BoundaryField upper =
      numbers(field_names::kThicknessUpper, of_vertices, [](const Thickness& t) { return t.diameter.upper; });
  upper.rounding = FieldRounding::kUp;
  fields.of_vertices.push_back(std::move(lower));
  fields.of_vertices.push_back(std::move(upper));
  fields.of_vertices.push_back(
      numbers(field_names::kObjectAngle, of_vertices, [](const Thickness& t) { return t.object_angle; }));
  BoundaryField kinds =
      numbers(field_names::kThicknessKind, of_vertices, [](const Thickness& t) { return static_cast<double>(t.kind); });
  kinds.is_whole = true;
  fields.of_vertices.push_back(std::move(kinds));
  fields.of_balls.push_back(
      vectors(field_names::kBallCentre, of_vertices, [](const Thickness& t) -> const Point& { return t.ball.centre; }));
  fields.of_balls.push_back(
      numbers(field_names::kBallRadius, of_vertices, [](const Thickness& t) { return t.ball.radius; }));
  fields.of_balls.push_back(
      vectors(field_names::kContactA, of_vertices, [](const Thickness& t) -> const Point& { return t.contacts[0]; }));
  fields.of_balls.push_back(
      vectors(field_names::kContactB, of_vertices, [](const Thickness& t) -> const Point& { return t.contacts[1]; }));
}

void add_curvature(BoundaryFields& fields, std::span<const VertexCurvature> of_vertices,
                   std::span<const MedialSphere> spheres) {
  using Item = VertexCurvature;
  const auto add = [&](BoundaryField field, bool is_whole = false) {
    field.is_whole = is_whole;
    fields.of_vertices.push_back(std::move(field));
  };
  add(numbers(field_names::kKappa1, of_vertices, [](const Item& c) { return c.kappa[0]; }));
  add(numbers(field_names::kKappa2, of_vertices, [](const Item& c) { return c.kappa[1]; }));
  add(vectors(field_names::kDirection1, of_vertices, [](const Item& c) -> const Point& { return c.directions[0]; }));
  add(vectors(field_names::kDirection2, of_vertices, [](const Item& c) -> const Point& { return c.directions[1]; }));
  add(numbers(field_names::kCurvatureError, of_vertices, [](const Item& c) { return c.error; }));
  add(numbers(field_names::kCurvatureState, of_vertices, [](const Item& c) { return static_cast<double>(c.state); }),
      true);
  const auto sheet = [&](const Item& c) -> double {
    return c.ball < spheres.size() ? std::max(spheres[c.ball].sheet, -1) : -1;
  };
  add(numbers(field_names::kSheet, of_vertices, sheet), true);
}

std::string_view kind_name(ThicknessKind kind) {
  constexpr std::array<std::string_view, kThicknessKinds.size()> kNames = {"none", "facets", "crease", "corner",
                                                                           "wall"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view state_name(CurvatureState state) {
  constexpr std::array<std::string_view, kCurvatureStates> kNames = {
      "known", "cut", "curve", "point", "seam", "few", "nested", "focal", "uncertain", "exposed", "edge"};
  return kNames[static_cast<std::size_t>(state)];
}

}  // namespace medial_vk
