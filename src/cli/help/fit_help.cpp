// The text of `medial-vk fit --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

std::string fit_help_text() {
  return R"(medial-vk fit puts capsules, cone-spheres or slabs in the place of a solid:
convex hulls of two or three balls each. They lie inside, proved one by one, and
flat or thin parts need far fewer of them than balls.

Usage:
  medial-vk fit [options] MESH              "-": standard input
  medial-vk spheres --primitives KIND [options] MESH      the same

Examples:
  medial-vk fit part.stl --count 16         writes part.hulls.json
  medial-vk fit part.stl --primitives capsules --count 16 -o part.usda
  medial-vk fit part.stl --error 0.2 -o part.glb --picture part.png
  medial-vk fit part.stl --primitives mix --parameters 96 --check

What is fitted:
      --primitives KIND balls (4 numbers each), capsules (7), cones: two balls
                        each (8), slabs: three balls each (12; default), mix:
                        the best of these sets at the same goals

How many (goals that are given together must all be met):
      --count N         at most N hulls, 1 to 4096
      --parameters N    hulls with at most N numbers together
      --error E         as many as leave no more than E of the volume uncovered,
                        between 0 and 1
      --max-gap G       as many as leave no point of the surface farther than G
                        from the hulls, in units of the mesh
      --width W         volumes are between bounds that differ by at most W of
                        the solid's volume (default: a fiftieth of the share
                        left uncovered, within 0.00001 and 0.001)
      --resolution N    voxels along the longest side for the hulls to start
                        from, 1 to 4096 (default: 60, or more where that
                        finds few medial points)

Output:
  -o, --output FILE     .json: all numbers; .csv: a row for each hull; .ma:
                        balls, edges, triangles (Q-MAT); .usda: colliders for
                        USD; .glb, .gltf: meshes and implicit shapes; .obj:
                        meshes; "-": standard output (default: MESH's name with
                        .hulls.json, here)
      --format F        json, csv, ma, usda, glb, gltf or obj, whatever the name
      --picture FILE    a .png with the hulls in the solid
      --view FROM       front, back, left, right, top, bottom, iso or x,y,z
      --up AXIS         the axis that points up: x, y, z, -x, -y or -z
      --size WxH        of the picture, in pixels
      --report FILE     numbers of mesh, hulls, proof and run as JSON; "-":
                        standard output
      --check           test the hulls with the CPU reference, which uses
                        another method than the proof

Other:
      --backend B       what finds medial points: vulkan (default), or cpu: the
                        reference, slower, without Vulkan
      --device D        Vulkan device by index or part of its name (default: the
                        environment variable MEDIAL_VK_DEVICE, else the best)
      --threads N       CPU threads, 0 for all (default 0)
  -q, --quiet           only errors
  -v, --verbose         also each hull, and the time of each step
  -h, --help            print this and exit

Files appear whole or not at all. The number of threads changes no result.

Exit codes: 0 done, 1 internal error, 2 wrong usage or a goal out of reach, 3
MESH unreadable or invalid, 4 no usable Vulkan device, 5 out of memory, 6 cannot
write, 7 --check failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
