// Balls in the place of the solids of links and scene, for `medial-vk clearance --balls N`.
#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/clearance/robot_and_scene.h"
#include "cli/terminal/progress.h"
#include "medial_vk/body_group.h"
#include "medial_vk/context.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// The balls of all solids, in their order.
struct BallsOfSolids {
  std::vector<std::optional<SolidBalls>> balls;  ///< None: they are to be fitted.
  std::vector<std::string> names;                ///< Of body files, without their folder.
  std::size_t read = 0, fitted = 0;              ///< Solids, by the origin of their balls; neither: all others.

  bool has_all() const;
};

/// The balls that need no fit: those of body files of the scene, those in the folder of `--bodies`, and the shapes of
/// links of spheres alone. Those of a link are known only together, since its solids share a number of balls. Errors:
/// those of read_kept_body().
Result<BallsOfSolids> known_balls(const RobotAndScene& all, const ClearanceOptions& of_run, Progress& progress);

/// Fits up to `of_run.balls` balls inside the solids of each link whose balls are not known, and as many that cover
/// them, with proof; each file of the scene counts as a link, and links of the same solids are fitted once. A mesh
/// that is not closed encloses nothing and has a cover alone. Without a context, the CPU reference finds the medial
/// points. Errors: those of fit_parts().
Status fit_missing_balls(const RobotAndScene& all, const ClearanceOptions& of_run, std::optional<Context>& context,
                         Progress& progress, const std::stop_source& stop, BallsOfSolids& result);

/// Writes a body file for every fitted mesh to the folder of `--bodies`, all or none. `was_known` is the result of
/// known_balls(). Errors: kCannotWrite; those of encode_kept_body().
Status keep_fitted_balls(const RobotAndScene& all, const ClearanceOptions& of_run, const BallsOfSolids& was_known,
                         const BallsOfSolids& now);

/// Bodies without triangles, one for each solid. Precondition: all balls are known. Errors: those of Body::create().
Result<std::vector<GroupPart>> bodies_of_balls(const RobotAndScene& all, const BallsOfSolids& balls);

}  // namespace medial_vk::cli
