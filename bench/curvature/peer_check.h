// Whether the methods on meshes are right: checked on a sphere and on a torus before they are compared with ours.
#pragma once

namespace medial_vk::bench {

/// Prints what is wrong on stderr.
bool peers_are_right();

}  // namespace medial_vk::bench
