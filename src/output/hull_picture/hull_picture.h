// Pictures of hulls inside their solid.
#pragma once

#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"
#include "output/hull_files/hull_record.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"

namespace medial_vk {

/// The solid as glass, and in it the hulls as meshes, each in one of the colours in turn. Drawn on the CPU, on one
/// thread. Errors: those of mesh_of().
Result<Picture> draw_hulls(const HullRecord& record, const MeshView& solid, const PictureOptions& options);

}  // namespace medial_vk
