// The text of `medial-vk spheres --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

// long: a single text.
std::string spheres_help_text() {
  return R"(medial-vk spheres puts N balls in the place of a solid, or of every link of a
robot: for collision checks, distances, shadows. Tight, and with a proof.

Usage:
  medial-vk spheres [options] MESH          OBJ, PLY, STL, OFF, glTF, GLB, 3MF,
                                            FBX, COLLADA ...; "-": standard input
  medial-vk spheres [options] ROBOT.urdf    with the meshes that it names
  medial-vk spheres --primitives KIND ...   capsules, cones or slabs: see
                                            medial-vk fit --help

Examples:
  medial-vk spheres part.stl --count 64     writes part.spheres.csv
  medial-vk spheres robot.urdf --count-per-link 32    writes robot.spheres.urdf
  medial-vk spheres robot.urdf --total 100 -o robot.yml     for cuRobo
  medial-vk spheres part.obj --count 32 --frames bent.obj twisted.obj
  medial-vk spheres part.stl --error 0.05 --picture part.png    covers 95 %

How many spheres (goals that are given together must all be met):
      --count N         at most N, of a mesh
      --count-per-link N  at most N for each link of a robot, shared among its
                        geometries by need
      --total N         at most N for the whole robot, shared among its links so
                        that the least volume is left uncovered
      --error E         as many as leave no more than E of the volume uncovered
                        (cover: add so much; balanced: both), between 0 and 1
      --max-gap G       as many as leave no point of the surface farther than G
                        from the spheres, in units of the mesh (robot: metres)
      --max-reach R     with --contract cover: as few as reach out by no more
                        than R, in units of the mesh (robot: metres)
      --max-distance D  with --contract balanced: the surfaces of spheres and
                        solid are nowhere farther apart than D, in units of the
                        mesh (robot: metres), in either direction; with --count
                        a bound, alone as many as needed
      --levels          also N/2, N/4 ... 1 of them, to choose from at run time
                        (csv, json, foam)

What they guarantee:
      --contract WHAT   inside: no sphere reaches out of the solid (default);
                        cover: all of the solid is covered, for safety;
                        balanced: neither, the least volume between spheres and
                        solid; both: inside and cover, N of each, chosen for
                        distances, with the mesh in a body file (part.body.npz),
                        for medial-vk distance
      --by WHAT         of spheres inside: volume, least uncovered (default);
                        distance, none of the surface far from all spheres, as
                        for thin links; auto, by distance where N spheres can
                        have no more than half of the volume
      --method HOW      best: chosen and moved for the least volume uncovered, or
                        as the contract requires (default); source: one
                        sphere per voxel, the largest voxels with no more than N
                        (Stolpner 2011, 7.3.2)
      --resolution N    voxels along the longest side for the spheres to choose
                        from, 1 to 4096 (default: by the count); with --method
                        source it stands for the count
      --object-angle A  of --method source: smallest object angle of medial
                        spheres, radians, between 0 and pi/2 (default 0.6)

Of a mesh that deforms:
      --frames [FILE...]  the spheres that, as they follow it, leave least of
                        the solid uncovered in all frames together, instead of
                        the best at rest: meshes with the same triangles, or a
                        pattern such as "walk_*.obj"; without a FILE those of
                        the animation of MESH, a .gltf or .glb; with --count,
                        of contract inside
      --animation NAME  of a scene with several: the name, or the number from 1

Robots:
      --collision       the links' <collision> geometry (default)
      --visual          their <visual> geometry
      --package NAME=FOLDER  where package://NAME is; as often as needed. Others
                        are looked for along ROS_PACKAGE_PATH and
                        AMENT_PREFIX_PATH, and around the URDF

Output:
  -o, --output FILE     .csv, .json, .urdf (the robot with spheres for
                        collision), .yml (cuRobo) or .xrdf, with --contract both
                        a body file, .npz; "-": standard output
                        (default: the input's name with .spheres.csv, of a robot
                        .spheres.urdf, with --levels .spheres.json, here)
      --each            a set for each mesh of a scene (glTF, 3MF, FBX ...)
                        instead of one for all: every output is a file with
                        the mesh's name before its extension
      --format NAME     csv, json, foam, curobo, xrdf or urdf, whatever the file
                        is called
      --picture FILE    a .png of the spheres; of a robot, all joints at zero;
                        with --contract both the two sets side by side
      --view FROM       of the picture: front, back, left, right, top, bottom,
                        iso or x,y,z, the direction towards the viewer
      --up AXIS         of the picture: x, y, z, -x, -y or -z (default y; robots
                        want z)
      --histogram FILE  .svg or .csv: how far surface and spheres are apart, by
                        area (of a mesh)
      --report FILE     everything about the run as JSON; "-": standard output
      --keep-inner-faces
                        take faces inside the solid, such as those of a part
                        that reaches into another one, for its boundary, too

      --check           also test the contract by the independent CPU reference;
                        exit code 7 if it is not kept

Where it runs:
      --backend B       vulkan (default), or cpu, which needs no Vulkan
      --device D        Vulkan device by index or part of its name (default: the
                        environment variable MEDIAL_VK_DEVICE, else the best)
      --threads N       CPU threads, 0 for all (default 0)

Other:
  -q, --quiet           only errors
  -v, --verbose         a line for each link; of a mesh, all measures
  -h, --help            print this and exit

Spheres are in the units of the mesh; of a robot in metres, in the frame of
their link. Files appear whole or not at all.

Exit codes: 0 done, 1 internal error, 2 wrong usage or a goal that cannot be
met, 3 mesh or robot unreadable or invalid, 4 no usable Vulkan device, 5 out of
memory, 6 cannot write, 7 --check failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
