#include "cli/options/measures.h"

namespace medial_vk::cli {

BoundaryColour boundary_colour_of(const Options& options) {
  if (options.boundary_colour) return *options.boundary_colour;
  return options.curvature && !options.thickness ? BoundaryColour::kShape : BoundaryColour::kThickness;
}

MeasuresOfBoundary measures_of(const Options& options) {
  const bool in_file = !options.boundary.empty(), names_one = options.thickness || options.curvature;
  const bool in_picture = !options.picture.empty() && options.look.show == PictureShow::kBoundary;
  const bool is_coloured = in_picture || options.boundary_colour.has_value();
  const bool by_thickness = is_coloured && boundary_colour_of(options) == BoundaryColour::kThickness;
  const bool by_curvature = is_coloured && boundary_colour_of(options) != BoundaryColour::kThickness;
  MeasuresOfBoundary out;
  const bool in_table = !options.thickness_histogram.empty() || !options.thickness_points.empty();
  out.thickness = options.thickness || in_table || by_thickness || (in_file && !names_one);
  out.curvature = options.curvature || options.strokes || by_curvature || (in_file && !names_one);
  const bool is_for_vertices = options.thickness || (in_file && !names_one);
  out.thickness_at_vertices = by_thickness || (is_for_vertices && (in_file || !options.html.empty()));
  return out;
}

}  // namespace medial_vk::cli
