// Bodies of links and scene that are kept in a folder from run to run, for `medial-vk clearance --bodies FOLDER`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/clearance/robot_and_scene.h"
#include "cli/options/clearance_options.h"
#include "medial_vk/result.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {

/// That the folder exists, or can be made where its own folder exists. Creates nothing. Error: kCannotWrite.
Status check_folder(const std::string& folder);

/// That files can be written in the folder, if it exists. Creates nothing. Error: kCannotWrite.
Status check_writable_folder(const std::string& folder);

/// Makes the folder if it does not exist. Error: kCannotWrite.
Status make_folder(const std::string& folder);

/// The name of a file for each solid of `all.solids`, from the name of the part and a digest of all that the fit of its
/// balls depends on: the meshes of its link, in their order, the number of balls of a link, and the resolution. Solids
/// with the same name have the same balls.
std::vector<std::string> names_of_bodies(const RobotAndScene& all, const ClearanceOptions& options);

/// The balls of solid `number` as the file at `path` holds them; none if there is no such file. Its mesh is compared
/// with that of the solid, and its balls are proved again: those inside in the facets within a curved shape, the cover
/// around those outside of it. Errors: kInvalidMesh (naming the file and what to do), kOutOfMemory, kInterrupted.
Result<std::optional<SolidBalls>> read_kept_body(const std::string& path, const RobotAndScene& all, std::size_t number,
                                                 unsigned threads);

/// The body file of solid `number` with these balls, proved as every reader does. Errors: kInternal (a proof fails),
/// kOutOfMemory, kInterrupted.
Result<OutputFile> encode_kept_body(const std::string& path, const RobotAndScene& all, std::size_t number,
                                    const SolidBalls& balls, unsigned threads);

}  // namespace medial_vk::cli
