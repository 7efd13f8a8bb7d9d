// Messages of all commands, and their output.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// The error of a run that a signal has stopped: kInterrupted.
Error stopped();

/// The commands of the tool, as far as their options differ.
enum class Command {
  kExtract,       ///< medial-vk
  kBatch,         ///< medial-vk batch, whose options are those of medial-vk
  kSpheres,       ///< medial-vk spheres, of a mesh
  kRobotSpheres,  ///< medial-vk spheres, of a robot
  kFit,           ///< medial-vk fit
  kDistance,      ///< medial-vk distance
  kClearance,     ///< medial-vk clearance
  kFollow,        ///< medial-vk follow
  kCurvature,     ///< medial-vk curvature
  kPlane,         ///< medial-vk plane
  kVoronoi,       ///< medial-vk voronoi
  kDoctor,        ///< medial-vk doctor
};

/// A parameter of the library by its name there, and its name in the messages of each command: an option of the
/// command, or words if there is no such option. Empty: no message of that command can contain the parameter.
struct ParameterWords {
  std::string_view parameter;
  std::string_view extract, spheres, robot_spheres;
  std::string_view doctor = {};     ///< Of few: its small extraction has options that cannot be at fault.
  std::string_view distance = {};   ///< Of few.
  std::string_view clearance = {};  ///< Of few; empty: that of distance.
  std::string_view follow = {};     ///< Of few.
  std::string_view plane = {};      ///< Of few.
  std::string_view voronoi = {};    ///< Of few.
  std::string_view fit = {};        ///< Of few; empty: that of spheres.
};

/// Every parameter that messages of the library name.
std::span<const ParameterWords> parameter_words();

/// Messages of the library name its parameters in backticks; the result names the options of the command instead.
std::string in_words_of_options(std::string message, Command command);

/// The exit code of an error.
int exit_code(ErrorCode code);

/// An error kNoDevice with a remedy appended; others unchanged. `device` is the argument of --device, or empty.
Error with_hint(Error error, const std::string& device = {});

/// With --each: the error of one mesh, number `i` of `count` from 0, with its name and what it means for the others.
Error error_in_part(Error error, std::size_t i, std::size_t count, const std::string& name);

/// Writes to standard output. Error: kCannotWrite.
Status print_result(const std::string& text);
/// Writes to standard error.
void print_message(const std::string& text);

/// Prints "medial-vk: message" in words of options; a usage error gets a hint at the help of the command. Returns the
/// exit code.
int report_error(const Error& error, Command command);

}  // namespace medial_vk::cli
