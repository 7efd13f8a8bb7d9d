// The text of --help: written by hand, to be read from top to bottom by new users.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

// long: a single text.
std::string help_text() {
  return R"(medial-vk finds the medial spheres of a solid: balls inside a triangle mesh
that touch its surface in two places, at most one per voxel.

Usage:
  medial-vk [options] MESH     OBJ, PLY, STL, OFF, glTF, GLB, 3MF, FBX, COLLADA
                               and more; "-": standard input
  medial-vk batch [options] FOLDER|LIST|MESH... -o OUT   many meshes in one
                               process: medial-vk batch --help
  medial-vk spheres [options] MESH|ROBOT.urdf   N balls in the place of a solid
                               or of a robot's links: medial-vk spheres --help
  medial-vk fit [options] MESH   capsules, cone-spheres or slabs in the place of
                               a solid: medial-vk fit --help
  medial-vk distance [options] A B   the distance between two solids, in many
                               poses: medial-vk distance --help
  medial-vk clearance [options] ROBOT.urdf   the same among links of a robot:
                               medial-vk clearance --help
  medial-vk follow [options] REST FRAME...   balls inside a mesh that deforms,
                               or around it: medial-vk follow --help
  medial-vk curvature [options] BALLS   how the boundary bends, from its medial
                               balls: medial-vk curvature --help
  medial-vk plane [options] SHAPE       the medial axis of a shape in the plane:
                               medial-vk plane --help
  medial-vk doctor [options]   whether it works on this machine, and what is
                               missing: medial-vk doctor --help

Examples:
  medial-vk bunny.obj                          writes bunny.medial.ply here
  medial-vk bunny.obj --picture bunny.png --show both    and a picture of it
  medial-vk part.stl --html part.html --up z   and a page to turn it, z up
  medial-vk part.stl -o p.csv --resolution 80  coarser, as a table
  medial-vk bunny.obj -o bunny.glb             the balls, for Blender or the web
  medial-vk bunny.obj --check                  tests every ball again on the CPU

Output:
  -o, --output FILE     medial points as .ply, .csv, .npz (NumPy) or .json, or
                        balls as .glb (glTF: a node for each); "-": PLY on
                        standard output (default: MESH's name with .medial.ply,
                        here)
      --each            a result for each mesh of a scene (glTF, 3MF, FBX ...)
                        instead of one for all: every output is a file with
                        the mesh's name before its extension
      --ascii           PLY as text instead of binary
      --mesh-spheres    balls as one triangle mesh, .ply or .glb (default:
                        MESH's name with .spheres.ply)
      --sphere-detail N how finely balls are cut into triangles, 0 to 5: 20 to
                        20480 each (default 2: 320; less where --mesh-spheres
                        would make a file of more than 4 GiB)
      --gpu-instancing  .glb with the extension EXT_mesh_gpu_instancing: small
                        and fast, but some programs do not know it
      --picture FILE    a .png of the mesh with its medial points, and of it:
      --show WHAT       points: in the mesh as glass (default), balls: their
                        union, both: side by side, boundary: the mesh itself
      --colour BY       of points: angle, the object angle (default), radius,
                        sheet; of the boundary, also in --boundary FILE.glb:
                        thickness (default), kappa1, kappa2, shape
      --strokes         lines along the principal directions, with --show
                        boundary: long ones along that of kappa 1
      --view FROM       front, back, left, right, top, bottom, iso or x,y,z, the
                        direction towards the viewer (default: from the right,
                        above and the front, 0.544,0.352,0.762 if y is up)
      --up AXIS         of the mesh, x, y, z, -x, -y or -z, in the picture and
                        at first on the page (default y; parts made in CAD: z)
      --size SIZE       pixels, WxH or N for a square, 16 to 16384 each (default
                        1200x900; 1800x900 with --show both)
      --html FILE       a page that shows mesh, balls, points and report in a
                        browser: one file, no network
      --medial-mesh FILE  points joined to a surface, .ply or .ma (Q-MAT)
      --sheet-curve FILE  .csv or .svg: the volume that is left when sheets go,
                        the least significant first, and so that topology stays
      --ball-volumes FILE  .csv: what each ball adds to the union's volume
      --report FILE     everything about the run as JSON; "-": standard output

What is measured on the boundary, for summary, report, page and these files:
      --thickness       how thick the solid is, by area, as intervals
      --curvature       principal curvatures from the medial points; takes about
                        a third of a millisecond of a core for each
      --boundary FILE   the mesh as .ply, .glb, .vtp (ParaView), .npz or .json
                        with what is measured at its vertices: both, unless
                        --thickness or --curvature names one; "-": PLY on
                        standard output
      --boundary-edge E  with edges cut until none is longer than E times the
                        longest side, 0.001 to 1 (default: as they are), so that
                        large triangles have values inside
      --thickness-histogram FILE  .svg or .csv: thickness by area; "-": .csv on
                        standard output
      --thickness-points FILE  .npz, .json or .csv: the points by area, with
                        interval, kind (wall, crease, corner, facets), ball and
                        contacts; "-": .csv on standard output
      --thickness-delta D  balls count at a point if they come within D times
                        the longest side, below 0.1 (default 0.0005)
      --thickness-width W  the search for a point ends when its interval is no
                        wider than W times its lower end, 1e-6 to 1 (default
                        0.02), or four times that after 50 distances
      --least-wall      the thinnest wall of a closed mesh, proved to a
                        hundredth unless cells of space run out, and its place
      --least-gap       the same for gaps outside, up to a quarter of the
                        longest side
      --min-wall T      fail with exit code 8 and a list of places if a wall is
                        thinner than T by a hundredth or more, in the units of
                        the mesh, which must be closed; else that is proved
      --min-gap T       the same for gaps outside
      --wall-angle A    what counts as a wall: balls that touch both sides, with
                        an object angle of A radians, between pi/4 and pi/2
                        (default 1.2: edges sharper than 42 degrees count, too)

What is looked for (lengths are fractions, so units do not matter):
      --side inside|outside|both
                        of the boundary (default inside); outside in a box,
                        which is no wall and is then the bounding box below
      --margin M        outside: how far that box reaches beyond the mesh, in
                        units of the mesh or with % of its longest side, up to
                        1000% (default: half its longest side); at its
                        lower corner 1.44% further
      --resolution N    voxels along the longest side of the bounding box,
                        1 to 4096 (default 160)
      --object-angle A  keep points whose object angle, half the angle between
                        the directions to the two touching points, is at least
                        A radians, between 0 and pi/2 (default 0.6)
      --radius R        also keep balls of radius above R times the longest
                        side, 0 to 1 (default 0: off), in mode certified
                        only with an object angle of 0.15 or more
      --epsilon E       how far a point may be from the medial surface, as a
                        fraction of the voxel side, 0.001 to 0.5 (default 0.01)
      --mode MODE       certified: voxels are dismissed by proof (default)
                        thesis: the published search by sampled flux
      --extra-levels N  how often a difficult voxel is halved before it counts
                        as undecided, 0 to 10 (default 8)
      --simplify        drop points within E of another one in a voxel beside it
      --keep-inner-faces
                        take faces inside the solid, such as those of a part
                        that reaches into another one, for its boundary, too
      --perturb A       move every vertex by up to A times the longest side,
                        0 to 0.1, for degenerate solids (default 0: off)
      --seed N          seed of --perturb (default 1)

How points are grouped into sheets:
      --sheet-angle A   neighbours whose normals differ by at most A degrees
                        are of one sheet, 0 to 90 (default 5.7)
      --sheet-crease A  so are neighbours whose spokes turn by no more than A
                        degrees, as between facets of a round shape, 0 to 180
                        (default 10; 0: only the angle decides, as published)
      --sheet-border A  so are components if spokes turn by no more than A
                        degrees along their border, in the mean, 0 to 180
                        (default 77; none counts as below A - 30 or above
                        A + 4, and what a short border lacks as A + 4)
      --sheet-width W   components narrower than W times the diameter of their
                        balls, 0 to 1, go to those around them (default 0.17;
                        0: none)
      --absorb-fragments N  so do components of fewer than N points (default 0)
      --keep-volume V   keep only the most significant sheets, with at least V
                        of the volume of the union of balls, between 0 and 1
      --keep-topology   remove none of them without which the union had another
                        number of components, tunnels or cavities

Where it runs:
      --list-devices    show the Vulkan devices and exit
      --device D        Vulkan device by index or part of its name (default: the
                        environment variable MEDIAL_VK_DEVICE, else the best)
      --backend B       vulkan (default), or cpu: the reference in double
                        precision, one thread, needs no Vulkan
      --memory M        device memory to stay below, MiB or as 2G (default 1G)
      --threads N       CPU threads, 0 for all (default 0)

Other:
      --check           test every ball of the output against the mesh on the
                        CPU, print a table, and fail if any ball fails
      --kernel-times    in the report, time on the device by kernel and level
                        instead of by stage (mode certified)
  -q, --quiet           only errors
  -v, --verbose         more about levels and time
      --version         print the version and exit
  -h, --help            print this and exit

Results go to files or standard output, messages to standard error. Files appear
whole or not at all.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 mesh unreadable or
invalid, 4 no usable Vulkan device, 5 out of memory, 6 cannot write, 7 --check
failed, 8 a wall or gap below --min-wall or --min-gap, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
