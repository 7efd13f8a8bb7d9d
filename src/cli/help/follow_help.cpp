// The text of `medial-vk follow --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

// long: a single text.
std::string follow_help_text() {
  return R"(medial-vk follow moves balls inside a solid, or balls that cover it, with its
deforming surface. In every frame each ball is proved to be inside (by --rule
tangent, the default), or all balls together are proved to cover the solid, and
the volume between solid and balls is measured.

Usage:
  medial-vk follow [options] REST FRAME...   meshes with the same triangles, or
                                             patterns in quotes for names:
                                             walk_%04d.obj, walk_####.obj,
                                             walk_*.obj or walk_[1-9].obj
  medial-vk follow [options] PATTERN         its first file as REST, and the
                                             others as frames, in the order of
                                             the numbers in their names
  medial-vk follow [options] SCENE           a .gltf or .glb with an animation:
                                             skins, shapes or moving nodes

Examples:
  medial-vk follow part.obj bent.obj twisted.obj --count 100 -o part.npz
  medial-vk follow "walk_*.obj" -o walk.csv -o walk.glb
  medial-vk follow dancer.glb --html dancer.html --picture dancer.png
  medial-vk spheres part.obj --count 64          makes part.spheres.csv
  medial-vk follow part.obj bent.obj --balls part.spheres.csv --check
  medial-vk follow part.obj bent.obj --contract cover --count 32 -o cover.npz

The motion:
      --animation NAME  of a scene with several: the name, or the number from 1
      --fps F           frames a second of an animation, and of what is written
                        (default 30)

The balls:
      --contract NAME   inside (default): no ball reaches out of the solid;
                        cover: no point of the solid is left out
      --count N         fit so many balls to the mesh at rest (default 500, of a
                        cover 100, as covers take longer)
      --points          all medial points instead, at --resolution N, which
                        must then be given
      --balls FILE      balls in a file: a table (CSV) with the columns x, y, z
                        and radius, a medial PLY, or .npz or .json that this
                        program wrote; "-": a table on standard input. They must
                        be inside, or cover the mesh at rest
      --resolution N    voxels along the longest side, for balls to choose from
                        (default: by the number of balls), or with --points
      --backend NAME    vulkan or cpu (the reference, slow) finds them
      --device NAME     index or part of the name of the Vulkan device

How both follow:
      --steps N         steps of each frame, towards more volume of balls inside
                        (--rule tangent), less of a cover (default 1)

How balls inside follow:
      --rule NAME       tangent (default): a ball keeps two contacts, and is as
                        large as it can be inside; published: one contact, as
                        in the source, and balls that may reach out a little
      --from-rest       compute each frame from rest, not from the frame before
      --renew N         choose up to N balls of a frame anew, at gaps, where the
                        uncovered volume of the solid, or of regions of its
                        surface, has grown (default 25; 0 of an open mesh, with
                        --rig, and as published)
      --renew-factor F  to more than F times that at rest (default 1.5)
      --protrusion XI   for published: how far balls may reach out, as a share
                        of the longest side (default 0.0025)
      --shrunk S        a ball below S of its radius at rest, or of that with
                        which it was chosen anew, counts as shrunk (default 0.5)
      --object-angle A  a ball whose contacts are nearer to each other, in
                        radians, counts as flat: no longer medial (default 0.5)

How a cover follows:
      --tighten         divide the surface of each frame among the balls anew,
                        by at least four steps, so that they become smaller;
                        takes some twenty times as long
      --grown G         a ball above G times its radius at rest counts as grown
                        (default 1.25)

Output:
  -o, --output FILE     may be given several times (default: REST.follow.npz)
                        .npz: the balls of all frames, frames x balls x 4
                        .glb: balls as an animation
                        .csv: a line per frame: volumes, the one-sided Hausdorff
                        distance from the surface to the balls (cover: from the
                        balls to the solid), and the number of balls in each
                        state; "-": that table on standard output
      --picture FILE    a .png with up to twelve frames side by side
      --html FILE       a page that plays the motion
      --rig FILE        the balls bound to the joints of the animation
                        .glb, .gltf: a copy of the scene with each ball as a
                        node below one joint, which any engine moves; in each
                        frame the node lies within the proved ball, and is that
                        ball where the joint does not scale
                        .json: each below up to four joints, with weights, for
                        engines that move vertices so
      --view FROM       of the picture: front, back, left, right, top, bottom,
                        iso or x,y,z, the direction towards the viewer
      --up AXIS         of picture and page: x, y, z, -x, -y or -z (default y)
      --check           also test every ball of every frame by the independent
                        CPU reference; exit code 7 if one reaches out, or if a
                        cover leaves a point out
      --threads N       CPU threads, 0 for all (default 0)

Other:
  -q, --quiet           only errors
  -v, --verbose         also what was assumed of the mesh, and the time of each
                        step
  -h, --help            print this and exit

The first frame that is written is the rest pose. No volume is known of a frame
that is flat, or whose faces cross, lie inside or are turned over. A ball inside
that finds no place in a frame is lost there, with radius 0, and may return;
faces inside the solid bound it, too. A cover holds every point whose winding
number is not 0; of a mesh that is not closed, the surface. Files appear whole
or not at all.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 mesh or frame unreadable
or invalid, 4 no Vulkan device, 5 out of memory, 6 cannot write, 7 --check
failed, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
