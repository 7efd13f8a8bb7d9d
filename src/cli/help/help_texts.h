// The texts of --help: written by hand, to be read from top to bottom by new users.
#pragma once

#include <string>

namespace medial_vk::cli {

/// The output of `medial-vk --help`.
std::string help_text();

// The output of `medial-vk COMMAND --help`.
std::string batch_help_text();
std::string spheres_help_text();
std::string fit_help_text();
std::string distance_help_text();
std::string clearance_help_text();
std::string follow_help_text();
std::string curvature_help_text();
std::string plane_help_text();
std::string voronoi_help_text();
std::string doctor_help_text();

}  // namespace medial_vk::cli
