// The text of `medial-vk distance --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

std::string distance_help_text() {
  return R"(medial-vk distance holds the distance between two solids, in one pose or in
many, in an interval that no rounding error leaves, and decides whether they
collide. It needs no Vulkan.

Usage:
  medial-vk distance [options] A B    meshes: OBJ, PLY, STL, OFF, glTF, GLB, 3MF,
                                      FBX, COLLADA ...; "-": standard input; or
                                      body files (.npz), with balls

Examples:
  medial-vk distance part.stl turtle.obj    where they are, as two lines of CSV
  medial-vk distance part.stl part.stl --poses poses.csv -o distances.csv
  medial-vk distance part.stl turtle.obj --tolerance 0.001 --check
  medial-vk spheres part.stl --contract both --count 100    part.body.npz
  medial-vk distance part.body.npz part.body.npz --poses poses.csv --balls

Where B is:
      --poses FILE      a table (CSV) with a pose of B in the frame of A per
                        line. The first line names the columns: x,y,z, the
                        shift, and qx,qy,qz,qw, the rotation as a quaternion,
                        in any order; "-": standard input (default: one pose,
                        both meshes as they are)

What is computed:
      --tolerance T     intervals may be as wide as T, in units of the mesh
                        (default 0: as narrow as rounding allows)
      --limit L         prove no more than that a distance is at least L; 0:
                        decide free or hit alone, which is fastest
      --surfaces        the distance of the surfaces: a solid inside another one
                        is not at distance 0
      --balls           bounds by the balls of two body files alone, without
                        triangles: wider intervals, in microseconds
      --keep-inner-faces
                        of meshes: take faces inside the solid, such as those of a part
                        that reaches into another one, for its boundary, too
      --check           also test every interval against all pairs of triangles,
                        by the independent CPU reference; seconds a pose for
                        large meshes; exit code 7 if one is wrong

Output:
  -o, --output FILE     a .csv; "-": standard output (default). A line per pose:
                        lower and upper end of the interval, the state (free,
                        hit or undecided), and the nearest points of A and B, in
                        the frame of A; with --balls, points of two balls inside
      --picture FILE    a .png of both solids in the pose of the least distance,
                        with their nearest points; with --balls, the balls that
                        decided, and of body files without it those that bound
                        the distance
      --html FILE       a page with that picture, the states of all poses and a
                        histogram of their distances
      --row N           show the pose of the N-th line of the poses, from 1, in
                        picture and page (default: that of the least distance:
                        the least upper end, the first of several)
      --view FROM       of the picture: front, back, left, right, top, bottom,
                        iso or x,y,z, the direction towards the viewer
      --up AXIS         of the picture: x, y, z, -x, -y or -z (default y)
      --threads N       CPU threads, 0 for all (default 0)

Other:
  -q, --quiet           only errors
  -v, --verbose         also what was assumed of the meshes, and the time of each
                        step
  -h, --help            print this and exit

Free: the solids have no common point. Hit: they have one, and both points are
such a point. Undecided: they may touch, to within rounding or the tolerance.
A mesh that is not closed counts as a surface that encloses nothing. Files appear
whole or not at all.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 mesh or poses unreadable
or invalid, 5 out of memory, 6 cannot write, 7 --check failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
