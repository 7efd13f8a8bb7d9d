// The text of `medial-vk curvature --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

std::string curvature_help_text() {
  return R"(medial-vk curvature measures how the boundary of a solid bends, from its medial
balls alone: both places where each ball touches, and there the principal
curvatures and directions, with an estimate of their error. It needs no mesh and
no Vulkan.

Usage:
  medial-vk curvature [options] BALLS   a table (.csv) with the columns x, y, z
                                        and radius; a medial PLY; .npz or .json
                                        that this program wrote; "-": a table on
                                        standard input

Examples:
  medial-vk turtle.obj --object-angle 0.3 -o turtle.medial.ply
  medial-vk curvature turtle.medial.ply        writes turtle.curvature.ply here
  medial-vk curvature turtle.medial.ply -o turtle.npz --report curvature.json
  medial-vk curvature turtle.medial.ply --method source -o source.csv

What is computed:
      --method fits|source
                        fits: polynomials along the sheets give the spokes, from
                        centres and radii alone, and the curvatures, with an
                        error. source: differences of the spokes in the file, as
                        published, for comparison (default fits)
      --spacing L       the distance of neighbouring balls along a sheet, as the
                        side of the voxels (default: estimated)
      --step N          source: the step, in spacings, at least 3.4642
                        (default 6)
      --smooth          source: average the spokes of neighbours first, for
                        solids that are not convex
      --threads N       CPU threads, 0 for all (default 0)

Output:
  -o, --output FILE     .ply: a point for each place of contact; .csv: a line
                        for each; .npz (NumPy) or .json: by ball; .glb (glTF):
                        points with attributes; "-": CSV on standard output
                        (default: BALLS's name with .curvature.ply, here)
      --report FILE     counts of states and ranges of curvatures as JSON; "-":
                        standard output

Other:
  -q, --quiet           only errors
  -v, --verbose         also the time of each step
  -h, --help            print this and exit

Curvatures are positive where the boundary is convex; the greater one is first.
Balls that reach to the rims of sheets give better values: find them with an
object angle of 0.3. States of a place of contact: known; cut (by a rim or a
seam); curve (one curvature is known, around a tube); point (a sphere); exposed
(at a seam or with few neighbours: the part of the ball that no other one covers
tells the place). Unknown are: seam, few (neighbours), nested (in another ball),
focal (no such boundary), uncertain (the error would be too great). Files appear
whole or not at all.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 balls unreadable or
invalid, 5 out of memory, 6 cannot write, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
