// The text of `medial-vk plane --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

std::string plane_help_text() {
  return R"(medial-vk plane finds the medial axis of a shape in the plane: exact lines and
parabolas with radius and object angle, as a graph. It needs no Vulkan.

Usage:
  medial-vk plane [options] SHAPE       .svg, .geojson, .wkt, or a .csv of x, y
                                        and ring; "-": standard input
  medial-vk plane [options] MESH --slice z=HEIGHT

Examples:
  medial-vk plane letter.svg                    writes letter.axis.json here
  medial-vk plane letter.svg -o axis.svg --picture axis.png --html axis.html
  medial-vk plane letter.svg --prune-significance 5% --smooth 2% -o line.geojson
  medial-vk plane turtle.obj --slice z=50% -o slice.csv --report slice.json

Shape (lengths: in units of the shape, or with % of its longest side):
      --slice AXIS=H    the shape is a slice of a mesh: x=, y= or z=, at a
                        coordinate or, with %, at a share of the box
      --fill nonzero|evenodd
                        what is inside of rings that cross or overlap
                        (default: what the format says)
      --flatness F      the greatest error of polygons for curves, in units of
                        the file (default: 0.01 % of the longest side)

What is computed:
      --side inside|outside|both
                        of the boundary (default inside)
      --margin M        outside: how far beyond the shape's box (default: half
                        its longest side)
      --object-angle T  points of the axis have at least this object angle,
                        radians (default 0.6)
      --radius R        points of at least this radius need 0.15 only
                        (default: off)
      --mode certified|thesis
                        the exact axis, proved (default), or points of it as
                        Chapter 4 of the source publishes

What is kept of it, in this order:
      --prune-length L  without branches from which all ways outwards to an end
                        are shorter than L
      --prune-significance S
                        without branches whose erosion thickness is below S: all
                        that is lost is within S of the discs that stay
      --longest-path    a centre line: the longest of the shortest paths
                        between two ends, for each part

Output:
  -o, --output FILE     .json: the graph with everything; .geojson: branches as
                        lines, junctions and ends as points; .svg: shape and
                        axis; .csv: points of branches; "-": JSON on standard
                        output (default: SHAPE's name with .axis.json, here)
      --step D          branches as polylines, no farther than D from the
                        curves (default 0.01%)
      --smooth W        polylines averaged over about W along their length;
                        they stay in the medial discs
      --picture FILE    a .png with the shape, the axis and some discs
      --html FILE       a page to look at the axis in a browser
      --colour radius|angle
                        what the colours of pictures show (default radius)
      --report FILE     numbers of shape, axis and run as JSON; "-": standard
                        output
      --check           test every point by brute force, and samples of the
                        exact axis

Other:
      --threads N       CPU threads, 0 for all (default 0)
  -q, --quiet           only errors
  -v, --verbose         also the time of each step
  -h, --help            print this and exit

Files appear whole or not at all. The number of threads changes no result.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 shape unreadable or
invalid, 5 out of memory, 6 cannot write, 7 --check failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
