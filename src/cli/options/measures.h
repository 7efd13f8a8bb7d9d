// Which measures of the boundary a run needs for its outputs.
#pragma once

#include "cli/options/options.h"

namespace medial_vk::cli {

/// Curvature takes about a third of a millisecond of a core per medial point, so that only what an output needs is
/// measured.
struct MeasuresOfBoundary {
  bool thickness = false;  ///< At points that stand for equal parts of the area: for summary and report.
  bool thickness_at_vertices = false;
  bool curvature = false;  ///< At vertices.

  bool any() const { return thickness || curvature; }
  bool at_vertices() const { return thickness_at_vertices || curvature; }
};

/// --boundary alone has both; with --thickness or --curvature it has what these name.
MeasuresOfBoundary measures_of(const Options& options);

/// Of the picture of the boundary, and of vertices in glTF.
BoundaryColour boundary_colour_of(const Options& options);

}  // namespace medial_vk::cli
