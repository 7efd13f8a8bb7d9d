// A picture of a solid with balls inside it and balls that cover it.
#pragma once

#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/mesh.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"

namespace medial_vk {

/// Two panels of the same scale: the balls inside, in the glass of the mesh, and the union of the balls that cover it,
/// each set in its colour. Drawn on the CPU, on one thread: 1800 x 900 pixels.
Picture draw_body(const Mesh& mesh, std::span<const Ball> inside, std::span<const Ball> cover, const PictureView& view);

}  // namespace medial_vk
