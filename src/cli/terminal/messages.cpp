#include "cli/terminal/messages.h"

#include <fmt/format.h>

#include <utility>

#include "common/tool_errors.h"
#include "output/atomic_files/atomic_file.h"
#include "platform/files.h"

namespace medial_vk::cli {
namespace {

constexpr ParameterWords same(std::string_view parameter, std::string_view words) {
  return {parameter, words, words, words};
}
/// Of calls that the tool does not make, or not with values that can be at fault.
constexpr ParameterWords library_only(std::string_view parameter) { return same(parameter, {}); }

/// Of SiteRoadmap, which only one command makes.
constexpr ParameterWords of_voronoi(std::string_view parameter, std::string_view words) {
  return {parameter, {}, {}, {}, {}, {}, {}, {}, {}, words};
}

/// Of Follower, which only one command makes.
constexpr ParameterWords of_follow(std::string_view parameter, std::string_view words) {
  return {parameter, {}, {}, {}, {}, {}, {}, words};
}

/// Of fit_hulls(), which only one command calls.
constexpr ParameterWords of_fit(std::string_view parameter, std::string_view words) {
  return {parameter, {}, {}, {}, {}, {}, {}, {}, {}, {}, words};
}

constexpr std::string_view kRobotCount = "--count-per-link or --total";
constexpr ParameterWords kParameterWords[] = {
    {"aim", {}, "--by", "--by"},
    {"amplitude", "--perturb", {}, {}},
    {"angle", "--sheet-angle", {}, {}},
    library_only("ball"),
    library_only("balls"),
    library_only("balls_only"),
    library_only("bodies"),
    library_only("body"),
    {"border", "--sheet-border", {}, {}},
    library_only("capacity"),
    library_only("cells"),
    library_only("clearance"),
    {"contract", {}, "--contract", "--contract"},
    {"count", {}, "--count", kRobotCount, {}, {}, {}, "--count"},
    {"count_per_link", {}, {}, "--count-per-link", {}, {}, "--balls"},
    of_follow("cover", "the file"),
    {"crease", "--sheet-crease", {}, {}},
    library_only("crease_angle"),
    same("deep_angle", "the deep angle"),
    library_only("delta"),
    library_only("depths"),
    {"device", "--device", "--device", "--device", "--device", {}, "--device", "--device"},
    library_only("directions"),
    {"epsilon", "--epsilon", "epsilon", "epsilon"},
    {"error", {}, "--error", "--error"},
    library_only("exact"),
    {"extra_levels", "--extra-levels", "the number of extra levels", "the number of extra levels"},
    library_only("for_distances"),
    library_only("frames"),
    of_voronoi("from", "--from"),
    library_only("group_size"),
    library_only("growth"),
    library_only("hulls"),
    library_only("inside"),
    {"keep_volume", "--keep-volume", {}, {}},
    library_only("largest"),
    {"limit", {}, {}, {}, {}, "--limit"},
    library_only("links"),
    library_only("lower"),
    {"margin", "--margin", {}, {}, {}, {}, {}, {}, "--margin", "--margin"},
    {"max_distance", {}, "--max-distance", "--max-distance"},
    {"max_gap", {}, "--max-gap", "--max-gap"},
    {"max_reach", {}, "--max-reach", "--max-reach"},
    {"medial_mesh", "--medial-mesh", {}, {}},
    {"memory_budget",
     "--memory",
     "the memory budget",
     "the memory budget",
     "the memory budget",
     {},
     {},
     "the memory budget"},
    library_only("mesh"),
    {"method", {}, "--method", "--method"},
    {"mode", "--mode", {}, {}},
    library_only("nearest"),
    {"object_angle",
     "--object-angle",
     "--object-angle",
     "--object-angle",
     {},
     {},
     {},
     "--object-angle",
     "--object-angle"},
    library_only("object_angles"),
    library_only("out"),
    library_only("pairs"),
    of_fit("parameters", "--parameters"),
    library_only("parts"),
    library_only("points"),
    library_only("pose"),
    library_only("poses"),
    of_follow("protrusion", "--protrusion"),
    library_only("queries"),
    library_only("query_error"),
    {"radius", "--radius", "the radius threshold", "the radius threshold", {}, {}, {}, {}, "--radius"},
    library_only("removal_orders"),
    {"resolution",
     "--resolution",
     "--resolution",
     "--resolution",
     "the resolution",
     {},
     "--resolution",
     "--resolution",
     {},
     "--resolution"},
    of_follow("renewal_factor", "--renew-factor"),
    of_follow("renewed", "--renew"),
    library_only("rings"),
    library_only("rotation"),
    library_only("samples"),
    library_only("sheets"),
    of_follow("shrunk", "--shrunk"),
    library_only("site_of_point"),
    library_only("site_of_segment"),
    library_only("sphere"),
    {"threads", "--threads", "--threads", "--threads", {}, {}, {}, "--threads"},
    of_voronoi("to", "--to"),
    {"tolerance", {}, {}, {}, {}, "--tolerance"},
    {"total", {}, {}, "--total"},
    library_only("upper"),
    library_only("validation"),
    {"volume", {}, {}, "volume"},
    library_only("volume_tolerance"),
    library_only("volumes"),
    {"wall_angle", "--wall-angle", {}, {}},
    {"width", "--sheet-width", {}, {}, {}, {}, {}, {}, {}, {}, "--width"},
};

std::string_view words_of(const ParameterWords& parameter, Command command) {
  switch (command) {
    case Command::kExtract:
    case Command::kBatch:
      break;
    case Command::kSpheres:
      return parameter.spheres;
    case Command::kRobotSpheres:
      return parameter.robot_spheres;
    case Command::kFit:
      return parameter.fit.empty() ? parameter.spheres : parameter.fit;
    case Command::kDistance:
      return parameter.distance;
    case Command::kClearance:
      return parameter.clearance.empty() ? parameter.distance : parameter.clearance;
    case Command::kFollow:
      return parameter.follow;
    case Command::kCurvature:
      return {};  // messages about curvature name no parameter
    case Command::kPlane:
      return parameter.plane;
    case Command::kVoronoi:
      return parameter.voronoi;
    case Command::kDoctor:
      return parameter.doctor;
  }
  return parameter.extract;
}

const char* name_of(Command command) {
  switch (command) {
    case Command::kExtract:
      break;
    case Command::kBatch:
      return "medial-vk batch";
    case Command::kSpheres:
    case Command::kRobotSpheres:
      return "medial-vk spheres";
    case Command::kFit:
      return "medial-vk fit";
    case Command::kDistance:
      return "medial-vk distance";
    case Command::kClearance:
      return "medial-vk clearance";
    case Command::kFollow:
      return "medial-vk follow";
    case Command::kCurvature:
      return "medial-vk curvature";
    case Command::kPlane:
      return "medial-vk plane";
    case Command::kVoronoi:
      return "medial-vk voronoi";
    case Command::kDoctor:
      return "medial-vk doctor";
  }
  return "medial-vk";
}

}  // namespace

Error stopped() { return {ErrorCode::kInterrupted, "interrupted; nothing was written"}; }

std::span<const ParameterWords> parameter_words() { return kParameterWords; }

std::string in_words_of_options(std::string message, Command command) {
  for (const ParameterWords& parameter : kParameterWords) {
    const std::string_view words = words_of(parameter, command);
    if (words.empty()) continue;
    const std::string quoted = fmt::format("`{}`", parameter.parameter);
    for (std::size_t at = message.find(quoted); at != std::string::npos; at = message.find(quoted, at)) {
      message.replace(at, quoted.size(), words);
    }
  }
  return message;
}

Error with_hint(Error error, const std::string& device) {
  if (error.code != ErrorCode::kNoDevice) return error;
  error.message += device.empty()
                       ? "\nInstall the Vulkan driver of your graphics card, or Mesa's CPU device (Debian: apt install "
                         "libvulkan1 mesa-vulkan-drivers), or use --backend cpu, which needs no Vulkan."
                       : "\nmedial-vk --list-devices shows the devices that are here.";
  error.message += "\nmedial-vk doctor shows what is there, what is missing, and what to do.";
  return error;
}

Error error_in_part(Error error, std::size_t i, std::size_t count, const std::string& name) {
  if (error.code == ErrorCode::kInterrupted) return error;
  const bool is_said = error.message.ends_with("nothing was written");
  const char* rest = count > 1 && !is_said ? "; nothing was written" : "";
  error.message = fmt::format("mesh {} of {}, {}: {}{}", i + 1, count, name, error.message, rest);
  return error;
}

Status print_result(const std::string& text) {
  const OutputFile file = {"-", text};
  return write_files({&file, 1});
}

void print_message(const std::string& text) { platform::write_all(platform::kStandardError, text); }

int exit_code(ErrorCode code) {
  if (code == kCannotWrite || code == kDiskFails) return 6;
  if (code == kCheckFailed) return 7;
  if (code == kWallTooThin) return 8;
  if (code == kSomeFailed) return 9;
  switch (code) {
    case ErrorCode::kUsage:
      return 2;
    case ErrorCode::kInvalidMesh:
      return 3;
    case ErrorCode::kNoDevice:
      return 4;
    case ErrorCode::kOutOfMemory:
      return 5;
    case ErrorCode::kInterrupted:
      return 130;
    case ErrorCode::kInternal:
      break;
  }
  return 1;
}

int report_error(const Error& error, Command command) {
  print_message(fmt::format("medial-vk: {}\n", in_words_of_options(error.message, command)));
  if (error.code == ErrorCode::kUsage) print_message(fmt::format("Try {} --help.\n", name_of(command)));
  return exit_code(error.code);
}

}  // namespace medial_vk::cli
