// The text of `medial-vk batch --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

std::string batch_help_text() {
  return R"(medial-vk batch runs medial-vk on many meshes in one process: the device stays
open, a mesh that fails does not stop the others, and a later run goes on where
this one ended.

Usage:
  medial-vk batch [options] FOLDER -o OUT     every mesh in it, at any depth
  medial-vk batch [options] LIST.txt -o OUT   a path in each line; "-": standard
                                              input
  medial-vk batch [options] MESH... -o OUT    and any mixture of these
  medial-vk batch --list [options] FOLDER -o OUT
  medial-vk batch --merge OUT... -o ALL [--html]

Examples:
  medial-vk batch parts -o results --resolution 80
  medial-vk batch parts -o results --resolution 80 --html --up z
  medial-vk batch list.txt -o other --format .npz --volumes --resolution 80

Output:
  -o, --output OUT      a folder, made if there is none; it gets batch.csv, with
                        a line for each mesh, and of each MESH the files
                        MESH.medial.ply and those of the options below, in
                        folders like those of the meshes
      --format .EXT     of the medial points: .ply (default), .csv, .npz, .json,
                        or .glb for balls
      --volumes         in the table also volume and area of the union of balls
      --html            a page, OUT/batch.html, with a picture and the numbers
                        of each mesh, and the pictures beside the other files

Runs that share the work:
      --list            only print the meshes, as a list for this command has
                        them, from the FOLDER or from the folder of the LIST
      --merge           inputs are folders OUT of runs, or a .txt that lists
                        them: one table, one page, links to files or copies

Files of each mesh, by an ending such as .png; medial-vk --help describes them:
      --report .json    MESH.report.json
      --picture .png    MESH.picture.png, with --show, --colour, --strokes,
                        --view, --up, --size (with --html alone: 400x300)
      --medial-mesh .ply|.ma
                        MESH.surface.ply
      --sheet-curve .csv|.svg
                        MESH.curve.csv
      --ball-volumes .csv
                        MESH.volumes.csv
      --boundary .EXT   MESH.boundary.vtp, with --boundary-edge
      --thickness-histogram .svg|.csv
                        MESH.thickness.svg
      --thickness-points .EXT
                        MESH.samples.csv

These hold for every mesh as they do for one in medial-vk --help:
  files     --ascii --mesh-spheres --sphere-detail --gpu-instancing
  search    --resolution --object-angle --radius --epsilon --mode --extra-levels
            --side --margin --simplify --keep-inner-faces --perturb --seed
  sheets    --sheet-angle --sheet-crease --sheet-border --sheet-width
            --absorb-fragments --keep-volume --keep-topology
  boundary  --thickness --thickness-delta --thickness-width --curvature
            --least-wall --least-gap --min-wall --min-gap --wall-angle
  device    --device --backend --memory --threads --kernel-times
  tests     --check

Other:
  -q, --quiet           only errors
  -v, --verbose         also a line for each mesh
  -h, --help            print this and exit

Left out in folders: names that begin with a dot, files in .medial.ply, and
folders below that hold a table of this command.

A mesh is not done again if the table says that it is done, its triangles, the
options and the version of the program are the same as then, and its files are
there. Files appear whole or not at all. Those that earlier runs have written
for a mesh are removed when it is done again.

Exit codes: 0 all meshes done, 1 internal error, 2 wrong usage, 3 no mesh, or an
input missing or unreadable, 4 no usable Vulkan device, 5 out of memory,
6 cannot write, 9 some meshes failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
