#include "cli/options/spheres_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "cli/options/declarations.h"
#include "cli/options/output_names.h"
#include "common/file_extension.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

constexpr std::uint64_t kMostSpheres = 1'000'000;

/// Arguments that do not correspond to a single field.
struct Given {
  std::optional<SphereFormat> format;
  std::optional<SphereContract> contract = SphereContract::kInside;  // no value: both
  bool collision = false;
  double object_angle = 0;  // 0: not given
  ViewChoice view;
};

void declare(CLI::App& app, SpheresOptions& options, Given& given) {
  SphereFitOptions& fit = options.spheres;
  Declarations add(app);
  add.text("INPUT", "file", options.input);
  add.flag("--each", options.each);
  add.text("-o,--output", "file", options.output);
  add.choice<std::optional<SphereFormat>>("--format",
                                          {{"csv", SphereFormat::kCsv},
                                           {"json", SphereFormat::kJson},
                                           {"foam", SphereFormat::kFoam},
                                           {"curobo", SphereFormat::kCurobo},
                                           {"xrdf", SphereFormat::kXrdf},
                                           {"urdf", SphereFormat::kUrdf}},
                                          given.format);
  add.whole("--count", 1, kMostSpheres, " spheres", fit.count);
  add.whole("--count-per-link", 1, kMostSpheres, " spheres", options.count_per_link);
  add.whole("--total", 1, kMostSpheres, " spheres", options.total);
  add.real("--error", {0, 1, false}, " of the volume", fit.error);
  add.real("--max-gap", {0, 1e30, false}, " (units of the mesh)", fit.max_gap);
  add.real("--max-distance", {0, 1e30, false}, " (units of the mesh)", fit.max_distance);
  add.real("--max-reach", {0, 1e30, false}, " (units of the mesh)", fit.max_reach);
  add.whole("--resolution", 1, 4096, " voxels", fit.resolution);
  add.choice<SphereMethod>("--method", {{"best", SphereMethod::kBest}, {"source", SphereMethod::kSource}}, fit.method);
  add.choice<std::optional<SphereContract>>("--contract",
                                            {{"inside", SphereContract::kInside},
                                             {"cover", SphereContract::kCover},
                                             {"balanced", SphereContract::kBalanced},
                                             {"both", std::nullopt}},
                                            given.contract);
  add.choice<SphereAim>(
      "--by", {{"volume", SphereAim::kVolume}, {"distance", SphereAim::kDistance}, {"auto", SphereAim::kAuto}},
      fit.aim);
  add.real("--object-angle", {0, std::numbers::pi / 2, false}, " radians", given.object_angle);
  add.flag("--levels", options.spheres.levels);
  add.texts_or_none("--frames", "files", options.frames);
  add.text("--animation", "name or number", options.animation);
  add.flag("--keep-inner-faces", options.keep_inner_faces);
  add.flag("--collision", given.collision);
  add.flag("--visual", options.visual);
  app.add_option("--package", options.packages)->type_name("name=folder")->allow_extra_args(false);
  add.text("--report", "file", options.report);
  add.text("--picture", "file", options.picture);
  add.text("--histogram", "file", options.histogram);
  add.flag("--check", options.check);
  add.view("--view", given.view);
  add.up("--up", options.view.up);
  add.choice<Backend>("--backend", {{"vulkan", Backend::kVulkan}, {"cpu", Backend::kCpu}}, options.backend);
  add.text("--device", "index or name", options.device);
  add.whole("--threads", 0, 1024, " threads", fit.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status check_there_is_input(const SpheresOptions& options) {
  if (!options.input.empty()) return {};
  return usage_error(options.frames.empty() ? "no MESH or ROBOT.urdf given"
                                            : "no MESH or ROBOT.urdf given (--frames takes all files that follow it: "
                                              "give MESH first)");
}

Status check_input(SpheresOptions& options, const Given& given) {
  if (Status status = check_there_is_input(options); !status) return status;
  const std::string extension = file_extension(options.input);
  if (extension == ".xacro") {
    return usage_error(
        fmt::format("'{}' is a macro for URDF: expand it first, xacro {} > robot.urdf", options.input, options.input));
  }
  options.is_robot = extension == ".urdf";
  if (options.is_robot && options.each) {
    return usage_error(
        "--each is about the meshes of a scene; the links of a robot have spheres of their own without it");
  }
  if (options.is_robot && !options.histogram.empty()) {
    return usage_error("--histogram is about the surface of one mesh; of a robot, give the meshes one by one");
  }
  if (options.is_robot) return {};
  const std::pair<const char*, bool> of_robots[] = {{"--count-per-link", options.count_per_link > 0},
                                                    {"--total", options.total > 0},
                                                    {"--visual", options.visual},
                                                    {"--collision", given.collision},
                                                    {"--package", !options.packages.empty()}};
  for (const auto& [name, is_given] : of_robots) {
    if (is_given)
      return usage_error(fmt::format("{} is about the links of a robot; '{}' is no .urdf", name, options.input));
  }
  return {};
}

/// Of the goals that are distances, and of what is chosen by them.
Status check_distances(const SpheresOptions& options) {
  const SphereFitOptions& fit = options.spheres;
  const bool is_best = fit.method == SphereMethod::kBest;
  if (fit.contract == SphereContract::kCover && fit.max_gap > 0) {
    return usage_error(
        "--max-gap: spheres that cover leave no gap; use --max-reach R, --error E, or a number of spheres");
  }
  if (fit.max_reach > 0 && (options.both || fit.contract != SphereContract::kCover || !is_best)) {
    return usage_error("--max-reach is about spheres that cover: use it with --contract cover and --method best");
  }
  if (fit.max_distance > 0 && (options.both || fit.contract != SphereContract::kBalanced || !is_best)) {
    return usage_error("--max-distance is about balanced spheres: use it with --contract balanced and --method best");
  }
  if (fit.max_reach > 0 && (fit.error > 0 || fit.levels)) {
    return usage_error("--max-reach: without --error and --levels; a number of spheres limits it");
  }
  if (fit.aim == SphereAim::kVolume) return {};
  if (options.both || fit.contract != SphereContract::kInside || !is_best) {
    return usage_error("--by is about spheres inside: use it with --contract inside and --method best");
  }
  if (fit.error > 0) return usage_error("--by: --error is about the volume; use a number of spheres or --max-gap G");
  return {};
}

Status check_goals(const SpheresOptions& options) {
  const SphereFitOptions& fit = options.spheres;
  if (options.is_robot && fit.count > 0) {
    return usage_error("--count is for one mesh; of a robot use --count-per-link N or --total N");
  }
  if (options.count_per_link > 0 && options.total > 0) {
    return usage_error("--count-per-link and --total cannot be used together");
  }
  if (Status status = check_distances(options); !status) return status;
  const bool by_source = fit.method == SphereMethod::kSource && fit.contract != SphereContract::kInside;
  if (by_source && (fit.error > 0 || fit.max_gap > 0)) {
    return usage_error(
        "--error and --max-gap: with --method source for --contract inside only; use a number of spheres");
  }
  const bool by_resolution = fit.method == SphereMethod::kSource && fit.resolution > 0;
  const bool any = fit.count > 0 || options.count_per_link > 0 || options.total > 0 || fit.error > 0 ||
                   fit.max_gap > 0 || fit.max_reach > 0 || fit.max_distance > 0 || by_resolution;
  if (any) return {};
  if (fit.contract == SphereContract::kCover && !options.both) {
    return usage_error(options.is_robot
                           ? "no goal is given: use --count-per-link N, --total N, --error E or --max-reach R"
                           : "no goal is given: use --count N, --error E or --max-reach R");
  }
  if (fit.contract == SphereContract::kBalanced && !options.both) {
    return usage_error(options.is_robot
                           ? "no goal is given: use --count-per-link N, --total N, --error E, --max-gap G or "
                             "--max-distance D"
                           : "no goal is given: use --count N, --error E, --max-gap G or --max-distance D");
  }
  return usage_error(options.is_robot ? "no goal is given: use --count-per-link N, --total N, --error E or --max-gap G"
                     : options.both   ? "no goal is given: use --count N or --error E"
                                      : "no goal is given: use --count N, --error E or --max-gap G");
}

/// Of a body file there is one form.
Status complete_body_output(SpheresOptions& options) {
  if (options.output.empty()) {
    options.output = (options.input == "-" ? "stdin" : platform::stem_of(options.input)) + ".body.npz";
  }
  if (may_end_in(options.output, ".npz")) return {};
  return usage_error(fmt::format("--output: with --contract both a body file is written, and '{}' does not end in .npz",
                                 options.output));
}

Status complete_output(SpheresOptions& options, const Given& given) {
  if (options.both) return complete_body_output(options);
  const SphereFormat usual = options.spheres.levels ? SphereFormat::kJson
                             : options.is_robot     ? SphereFormat::kUrdf
                                                    : SphereFormat::kCsv;
  options.format = given.format.value_or(usual);
  if (options.output.empty()) {
    constexpr const char* kExtensions[] = {".csv", ".json", ".foam.json", ".yml", ".xrdf", ".urdf"};
    const std::string stem = options.input == "-" ? "stdin" : platform::stem_of(options.input);
    options.output = stem + ".spheres" + kExtensions[static_cast<std::size_t>(options.format)];
  } else if (options.output != "-" && !given.format) {
    const Result<SphereFormat> format = sphere_format_of(options.output);
    if (!format) return usage_error("--output: " + format.error().message);
    options.format = format.value();
  }
  if (options.spheres.levels && !has_levels(options.format)) {
    return usage_error(fmt::format("--levels: the format {} has one set of spheres only; use csv, json or foam",
                                   name_of(options.format)));
  }
  return {};
}

Status complete_files(SpheresOptions& options, const Given& given) {
  if (Status status = complete_output(options, given); !status) return status;
  if (!may_end_in(options.picture, ".png")) {
    return usage_error(fmt::format("--picture: '{}' does not end in .png", options.picture));
  }
  const bool looks = given.view != ViewChoice() || options.view.up != PictureView().up;
  if (looks && options.picture.empty()) {
    return usage_error("--view and --up are about the picture: use them with --picture FILE.png");
  }
  options.view = view_of(given.view, options.view.up);
  if (!may_end_in(options.histogram, ".svg") && !may_end_in(options.histogram, ".csv")) {
    return usage_error(fmt::format("--histogram: '{}' ends in neither .svg nor .csv", options.histogram));
  }
  if (options.each) {
    if (Status status = check_no_stream(outputs_of(options)); !status) return status;
  }
  for (const std::string& frame : options.frames) {
    if (Status status = check_outputs_differ(outputs_of(options), frame); !status) return status;
  }
  return check_outputs_differ(outputs_of(options), options.input);
}

/// A body is one solid with two sets.
Status check_both(const SpheresOptions& options, const Given& given) {
  if (!options.both) return {};
  if (file_extension(options.input) == ".urdf") {
    return usage_error(
        "--contract both makes a body of one mesh. For the bodies of a robot's links use medial-vk clearance "
        "ROBOT.urdf "
        "--joints FILE.csv --balls N --bodies FOLDER; for spheres of its links use --contract inside or cover");
  }
  const std::pair<const char*, bool> of_one_set[] = {{"--each", options.each},
                                                     {"--levels", options.spheres.levels},
                                                     {"--max-gap", options.spheres.max_gap > 0},
                                                     {"--format", given.format.has_value()},
                                                     {"--histogram", !options.histogram.empty()}};
  for (const auto& [name, is_given] : of_one_set) {
    if (is_given) {
      return usage_error(
          fmt::format("{} is about one set of spheres: use it with --contract inside, cover or balanced", name));
    }
  }
  if (options.spheres.method == SphereMethod::kBest) return {};
  return usage_error("--method source: with --contract both only --method best is supported");
}

/// Without a file, --frames stands for MESH.
Status complete_frames(SpheresOptions& options) {
  if (options.frames != std::vector<std::string>{""}) return {};
  const std::string extension = file_extension(options.input);
  if (options.input != "-" && extension != ".glb" && extension != ".gltf") {
    return usage_error(
        fmt::format("--frames without a file stands for the animation of MESH, and {} is no .gltf or "
                    ".glb: name the meshes of the frames",
                    options.input));
  }
  options.frames = {options.input};
  return {};
}

/// Frames are files, which are read several times; or MESH alone, which stands for its animation.
Status check_files_of_frames(const SpheresOptions& options) {
  if (frames_are_animation(options)) return {};
  for (const std::string& frame : options.frames) {
    if (frame.empty()) return usage_error("--frames: the name of a file is empty");
    if (frame.size() > 1 && frame[0] == '-') {
      return usage_error(
          fmt::format("--frames: '{}' begins like an option; a file of this name is ./{}", frame, frame));
    }
    if (frame == "-") {
      return usage_error("--frames: frames are read several times, so none can be standard input (-)");
    }
    if (same_file(frame, options.input)) {
      return usage_error(
          fmt::format("--frames: {} is MESH itself, which is the rest pose; alone it stands for its animation", frame));
    }
  }
  if (options.animation.empty()) return {};
  return usage_error(fmt::format("--animation is about a scene: use --frames {}, too", options.input));
}

/// Spheres that follow a motion are one set inside one mesh, by number.
Status check_frames(SpheresOptions& options) {
  if (options.frames.empty()) {
    if (options.animation.empty()) return {};
    return usage_error("--animation is about a motion: use it with --frames");
  }
  if (Status status = check_there_is_input(options); !status) return status;
  if (file_extension(options.input) == ".urdf") {
    return usage_error("--frames are those of one mesh; the links of a robot do not deform");
  }
  if (Status status = complete_frames(options); !status) return status;
  const SphereFitOptions& fit = options.spheres;
  if (options.both || fit.contract != SphereContract::kInside) {
    return usage_error("--frames: only spheres of --contract inside follow a motion");
  }
  const std::pair<const char*, bool> of_rest[] = {{"--each", options.each},
                                                  {"--levels", fit.levels},
                                                  {"--error", fit.error > 0},
                                                  {"--max-gap", fit.max_gap > 0},
                                                  {"--by", fit.aim != SphereAim::kVolume},
                                                  {"--method source", fit.method == SphereMethod::kSource},
                                                  {"--keep-inner-faces", options.keep_inner_faces},
                                                  {"--picture", !options.picture.empty()},
                                                  {"--histogram", !options.histogram.empty()},
                                                  {"--report", !options.report.empty()}};
  for (const auto& [name, is_given] : of_rest) {
    if (is_given) return usage_error(fmt::format("{} is about a mesh that does not move: leave out --frames", name));
  }
  if (fit.count == 0) return usage_error("--frames: give the number of spheres with --count N");
  return check_files_of_frames(options);
}

Status check_combinations(SpheresOptions& options, const Given& given) {
  if (Status status = check_both(options, given); !status) return status;
  if (Status status = check_frames(options); !status) return status;
  if (options.check && options.spheres.contract == SphereContract::kBalanced) {
    return usage_error("--check: spheres of the contract balanced guarantee nothing that could be checked");
  }
  if (given.object_angle > 0 && options.spheres.method != SphereMethod::kSource) {
    return usage_error("--object-angle is of --method source; the method best chooses among all medial spheres");
  }
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (options.visual && given.collision) return usage_error("--collision and --visual cannot be used together");
  if (options.backend == Backend::kCpu && !options.device.empty()) {
    return usage_error("--device chooses a Vulkan device; it cannot be used with --backend cpu");
  }
  return {};
}

}  // namespace

bool frames_are_animation(const SpheresOptions& options) {
  return options.frames.size() == 1 && same_file(options.frames.front(), options.input);
}

std::vector<NamedOutput> outputs_of(const SpheresOptions& options) {
  return {{"--output", &options.output},
          {"--report", &options.report},
          {"--picture", &options.picture},
          {"--histogram", &options.histogram}};
}

SpheresOptions options_of_part(const SpheresOptions& options, const std::string& name) {
  SpheresOptions of_part = options;
  for (std::string* file : {&of_part.output, &of_part.report, &of_part.picture, &of_part.histogram}) {
    if (!file->empty()) *file = with_part(*file, name);
  }
  return of_part;
}

/// The application writes to the other members, so all stay together and do not move.
struct SpheresOptionParser::Declared {
  ReusableApp app;
  SpheresOptions options;
  Given given;
};

SpheresOptionParser::SpheresOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare(declared_->app, declared_->options, declared_->given);
}

SpheresOptionParser::~SpheresOptionParser() = default;

Result<SpheresOptions> SpheresOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  SpheresOptions& options = declared_->options = SpheresOptions();
  const Given& given = declared_->given = Given();
  if (Status status = parse_arguments(declared_->app, arguments, "one mesh or robot at a time"); !status)
    return status.error();
  if (options.help) return options;
  if (given.object_angle > 0) options.spheres.object_angle = given.object_angle;
  options.both = !given.contract;
  options.spheres.contract = given.contract.value_or(SphereContract::kInside);
  if (Status status = check_combinations(options, given); !status) return status.error();
  if (Status status = check_input(options, given); !status) return status.error();
  if (Status status = check_goals(options); !status) return status.error();
  if (Status status = complete_files(options, given); !status) return status.error();
  return options;
}

Result<SpheresOptions> parse_spheres_options(const std::vector<std::string>& arguments) {
  return SpheresOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
