// The text of `medial-vk voronoi --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

std::string voronoi_help_text() {
  return R"(medial-vk voronoi finds the surface between sites: all points at equal distance
from two different sites at least, and from no site less. Sites are meshes,
points, segments and triangles; in the plane, shapes. It needs no Vulkan.

Usage:
  medial-vk voronoi [options] SITE SITE ...     meshes; "-": standard input
  medial-vk voronoi [options] SHAPE SHAPE ...   .svg, .geojson, .wkt or .csv

Examples:
  medial-vk voronoi part.stl other.obj          writes part.voronoi.ply here
  medial-vk voronoi part.stl --point 0,0,9 -o v.obj --picture v.png
  medial-vk voronoi part.stl other.obj --roadmap map.json -q
  medial-vk voronoi letter.svg ring.svg -o curves.svg

Sites (numbered in this order: files, points, segments, triangles):
      --point X,Y,Z     a point; like the next two as often as you like
      --segment X,Y,Z,X,Y,Z
                        a segment between two points
      --triangle X,Y,Z,X,Y,Z,X,Y,Z
                        a triangle
      --split           the parts of a scene, or the connected parts of any
                        other mesh, are sites of their own

A closed mesh is a solid, and its inside belongs to it. Where solids overlap,
the surface is outside of both.

What is searched:
      --resolution N    voxels along the longest side of the box, 1 to 2048; at
                        most one point a voxel (default 160)
      --margin M        the box reaches this far beyond the sites, in their
                        units (default, also as 0: a quarter of the longest
                        side; in the plane a half)

Output:
  -o, --output FILE     .ply: points and faces; .obj, .glb: faces by pair; .csv:
                        points; .npz, .json: everything; "-": PLY on standard
                        output (default: the first SITE's name with
                        .voronoi.ply, here). In the plane .json, .geojson, .svg
                        or .csv (default .voronoi.json)
      --ascii           PLY as text
      --picture FILE    a .png with the sites, and the surface in a colour for
                        each pair
      --html FILE       a page for a browser: sites, faces by pair, roadmap; a
                        click shows pair, distance and directions
      --view FROM       front, back, left, right, top, bottom, iso or x,y,z
      --up AXIS         the axis that points up: x, y, z, -x, -y or -z
      --size WxH        of the picture, in pixels
      --roadmap FILE    the points as a graph for motion planning, .json: each
                        link with the radius of a ball that passes, proved
      --from X,Y,Z, --to X,Y,Z
                        in the roadmap: the path between two places with the
                        greatest width on this graph; in the plane X,Y
      --report FILE     numbers of sites, surface and run as JSON; "-": standard
                        output
      --check           test every point, and samples of the surface, with the
                        CPU reference; in the plane the curves and the widths

Other:
      --threads N       CPU threads, 0 for all (default 0)
  -q, --quiet           only errors
  -v, --verbose         also the time of each step
  -h, --help            print this and exit

Files appear whole or not at all. The number of threads changes no result.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 a site unreadable or
invalid, 5 out of memory, 6 cannot write, 7 --check failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
