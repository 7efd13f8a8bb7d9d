// The text of `medial-vk clearance --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

// long: a single text.
std::string clearance_help_text() {
  return R"(medial-vk clearance holds the least distance among the links of a robot and
its surroundings, for each configuration of the joints, in an interval that
no rounding error of distances leaves, and decides whether anything collides.
It needs no Vulkan, except to fit balls.

Usage:
  medial-vk clearance [options] ROBOT.urdf --joints FILE.csv

Examples:
  medial-vk clearance robot.urdf --joints joints.csv
  medial-vk clearance robot.urdf --scene part.stl --joints joints.csv -o c.csv
  medial-vk clearance robot.urdf --joints joints.csv --write-srdf robot.srdf -o self.csv
  medial-vk clearance robot.urdf --joints joints.csv --srdf robot.srdf --limit 0.05
  medial-vk clearance robot.urdf --joints joints.csv --balls 64 -o bounds.csv
  medial-vk clearance robot.urdf --joints joints.csv --balls 64 --bodies kept

What is compared:
      --joints FILE     a table (CSV) with a configuration per line, in radians
                        and metres. The first line names the columns, in any
                        order: one for each joint that moves and mimics no other
                        one; further columns are ignored; "-": standard input
      --scene FILE      a mesh that the robot must not touch, or a body file
                        (.npz) of one, in metres, in the frame of the robot's
                        root; as often as needed. All are compared with the
                        robot, and not with each other
      --srdf FILE       compare all pairs of links but those of the elements
                        <disable_collisions> (default: all but those that a
                        joint joins, that never move relative to each other, or
                        that touch in each of 256 configurations within limits)
      --visual          the visual shapes of the links, not those for collisions
      --package NAME=FOLDER  where package://NAME is; as often as needed. Others
                        are searched along ROS_PACKAGE_PATH and
                        AMENT_PREFIX_PATH, and around the URDF

What is computed:
      --tolerance T     intervals may be as wide as T, in metres (default 0: as
                        narrow as rounding allows)
      --limit L         prove no more than that a distance is at least L; 0:
                        decide free or hit alone, which is fastest
      --balls N         bounds by balls alone, without triangles: N that are
                        proved to lie inside the solids of each link, and N that
                        cover them, fitted in this run; a mesh of the scene
                        counts as a link, and a body file has its own balls.
                        Wider intervals, for many configurations. The fits take
                        seconds for each link (64 balls: 2 to 12 on one core),
                        and longer in proportion to N
      --bodies FOLDER   with --balls: keep the balls there, in a body file for
                        each mesh, and read those that earlier runs have kept
                        for the same meshes, N and --resolution, with a proof,
                        instead of fitting them again
      --decide          with --balls: triangles answer for the configurations
                        that balls leave undecided
      --keep-inner-faces
                        take faces inside a solid, such as those of a part that
                        reaches into another one, for its boundary, too
      --check           also test every interval against all pairs of triangles
                        of all pairs of links, by the independent CPU reference;
                        seconds a configuration for large meshes; exit code 7 if
                        one is wrong

Output:
  -o, --output FILE     a .csv; "-": standard output (default). A line per
                        configuration: its number, the state (free, hit or
                        undecided), lower and upper end of the interval, and
                        the two links, or link and scene file, that gave it
      --picture FILE    a .png of robot and scene in the configuration of the least
                        distance, with the two links, their nearest points and
                        with --balls the balls that decided
      --html FILE       a page with that picture, the states of all configurations
                        and a histogram of their distances
      --row N           show configuration N, as numbered in the output, in
                        picture and page (default: that of the least distance:
                        the least upper end, the first of several)
      --view FROM       of the picture: front, back, left, right, top, bottom,
                        iso or x,y,z, the direction towards the viewer
      --up AXIS         of the picture: x, y, z, -x, -y or -z (default y; robots
                        want z)
      --write-srdf FILE a .srdf with the pairs of links that were not compared
      --threads N       CPU threads, 0 for all (default 0)

How balls are fitted:
      --resolution N    voxels along the longest side of a solid for the balls to
                        choose from, 1 to 4096 (default: by their number)
      --backend B       vulkan (default), or cpu, which needs no Vulkan
      --device D        Vulkan device by index or part of its name (default: the
                        environment variable MEDIAL_VK_DEVICE, else the best)

Other:
  -q, --quiet           only errors
  -v, --verbose         also the pairs of links that always touch, and the time
                        of each step
  -h, --help            print this and exit

Free: no compared solids have a common point. Hit: two of them have one.
Undecided: neither is proved: they may touch, to within rounding, the tolerance,
the facets that stand for cylinders, capsules and spheres, or the balls. A mesh
that is not closed counts as a surface that encloses nothing. Files appear whole
or not at all.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 a file unreadable or
invalid, 4 no usable Vulkan device, 5 out of memory, 6 cannot write, 7 --check
failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
