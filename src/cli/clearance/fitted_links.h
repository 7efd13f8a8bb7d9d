// Balls in the place of the solids of links and scene, for `medial-vk clearance --balls N`.
#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

#include "cli/clearance/robot_and_scene.h"
#include "cli/terminal/progress.h"
#include "medial_vk/body_group.h"
#include "medial_vk/context.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Bodies without triangles, one for each solid, and how many balls they have in all.
struct FittedLinks {
  std::vector<GroupPart> parts;
  std::size_t inside = 0, cover = 0;
};

/// Fits up to `of_run.balls` balls inside the solids of each link, and as many that cover them, with proof; the files
/// of the scene are further links. A mesh that is not closed encloses nothing and has a cover alone. Without a context,
/// the CPU reference finds the medial points. Errors: those of fit_parts().
Result<FittedLinks> fit_links(const RobotAndScene& all, const ClearanceOptions& of_run, std::optional<Context>& context,
                              Progress& progress, const std::stop_source& stop);

}  // namespace medial_vk::cli
