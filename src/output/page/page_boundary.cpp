#include "output/page/page_boundary.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "output/boundary_colours/boundary_colours.h"
#include "output/colours/colour_map.h"
#include "output/page/page_parts.h"

namespace medial_vk::page {
namespace {

using BoundaryJson = nlohmann::ordered_json;

struct NamedColour {
  BoundaryColour colour;
  const char* name;   // In the page, and of --colour.
  const char* label;  // For readers.
};

constexpr NamedColour kNamedColours[] = {{BoundaryColour::kThickness, "thickness", "Thickness"},
                                         {BoundaryColour::kKappa1, "kappa1", "Kappa 1"},
                                         {BoundaryColour::kKappa2, "kappa2", "Kappa 2"},
                                         {BoundaryColour::kShape, "shape", "Shape"}};

/// As spokes are written: a component of 1 is this.
constexpr double kUnit = 32767;

bool is_direction(const BoundaryField& field) {
  return field.name == field_names::kDirection1 || field.name == field_names::kDirection2;
}

std::string css_of(const Eigen::Vector3f& colour) {
  return fmt::format("rgb({} {} {})", picture::byte_of(colour.x()), picture::byte_of(colour.y()),
                     picture::byte_of(colour.z()));
}

BoundaryJson colour_json(const NamedColour& named, const BoundaryColours& colours) {
  BoundaryJson bar = BoundaryJson::array(), swatches = BoundaryJson::array();
  for (const Eigen::Vector3f& colour : colours.bar) bar.push_back(css_of(colour));
  for (const auto& [colour, name] : colours.swatches) swatches.push_back({css_of(colour), name});
  return {{"name", named.name},     {"label", named.label},         {"title", colours.title}, {"bar", bar},
          {"least", colours.least}, {"greatest", colours.greatest}, {"swatches", swatches}};
}

}  // namespace

BoundaryJson boundary_json(const BoundaryFields& fields, double longest_side) {
  if (fields.of_vertices.empty()) return nullptr;
  BoundaryJson colours = BoundaryJson::array(), names = BoundaryJson::array(), states = BoundaryJson::array(),
               kinds = BoundaryJson::array(), directions = BoundaryJson::array();
  for (const NamedColour& named : kNamedColours) {
    if (!can_colour(fields, named.colour)) continue;
    colours.push_back(colour_json(named, colour_boundary(fields, named.colour, longest_side)));
  }
  for (const BoundaryField& field : fields.of_vertices) {
    if (field.components == 1) names.push_back(field.name);
    if (is_direction(field)) directions.push_back(field.name);
  }
  for (std::size_t i = 0; i < kCurvatureStates; ++i) states.push_back(state_name(static_cast<CurvatureState>(i)));
  for (const ThicknessKind kind : kThicknessKinds) kinds.push_back(kind_name(kind));
  return {{"colours", colours}, {"fields", names}, {"states", states}, {"kinds", kinds}, {"directions", directions}};
}

void write_boundary(std::string& page, const BoundaryFields& fields, double longest_side) {
  for (const NamedColour& named : kNamedColours) {
    if (!can_colour(fields, named.colour)) continue;
    const std::vector<Eigen::Vector3f> colours = colour_boundary(fields, named.colour, longest_side).of_vertices;
    const std::string block_name = fmt::format("colour-{}", named.name);
    Block block(block_name, 3 * colours.size());
    for (const Eigen::Vector3f& colour : colours) {
      for (Eigen::Index k = 0; k < 3; ++k) block.add(picture::byte_of(colour[k]));
    }
    block.write(page);
  }
  for (const BoundaryField& field : fields.of_vertices) {
    if (field.components != 1 && !is_direction(field)) continue;
    const std::string block_name = fmt::format("field-{}", field.name);
    Block block(block_name, 4 * field.values.size());
    for (const double value : field.values) {
      if (!is_direction(field)) {
        block.add(static_cast<float>(value));
      } else {
        block.add(static_cast<std::int16_t>(std::isnan(value) ? 0 : std::lround(kUnit * value)));
      }
    }
    block.write(page);
  }
}

}  // namespace medial_vk::page
