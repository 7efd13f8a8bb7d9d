#include "cli/options/clearance_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>

#include "cli/options/declarations.h"
#include "common/file_extension.h"

namespace medial_vk::cli {
namespace {

constexpr double kGreatestClearance = 1e30;
constexpr std::uint64_t kMostBalls = 100'000;

void declare_clearance(CLI::App& app, ClearanceOptions& options, ViewChoice& view) {
  Declarations add(app);
  add.text("ROBOT", "file", options.robot);
  app.add_option("--scene", options.scenes)->type_name("file")->allow_extra_args(false);
  app.add_option("--package", options.packages)->type_name("name=folder")->allow_extra_args(false);
  add.text("--joints", "file", options.joints);
  add.text("--srdf", "file", options.srdf);
  add.text("--write-srdf", "file", options.write_srdf);
  add.text("-o,--output", "file", options.output);
  add.text("--picture", "file", options.picture);
  add.text("--html", "file", options.html);
  add.row("--row", options.row);
  add.view("--view", view);
  add.up("--up", options.view.up);
  add.whole("--balls", 1, kMostBalls, " balls for each link", options.balls);
  add.text("--bodies", "folder", options.bodies);
  add.flag("--decide", options.decide);
  add.whole("--resolution", 1, 4096, " voxels", options.resolution);
  add.choice<Backend>("--backend", {{"vulkan", Backend::kVulkan}, {"cpu", Backend::kCpu}}, options.backend);
  add.text("--device", "index or name", options.device);
  add.real("--tolerance", {0, kGreatestClearance, true}, " (metres)", options.tolerance);
  add.real("--limit", {0, kGreatestClearance, true}, " (metres)", options.limit);
  add.flag("--visual", options.visual);
  add.flag("--keep-inner-faces", options.keep_inner_faces);
  add.flag("--check", options.check);
  add.whole("--threads", 0, 1024, " threads", options.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status check_clearance_inputs(const ClearanceOptions& options) {
  if (options.robot.empty()) return usage_error("give a robot, ROBOT.urdf");
  if (file_extension(options.robot) != ".urdf") {
    return usage_error(fmt::format("'{}' does not end in .urdf", options.robot));
  }
  if (options.joints.empty()) return usage_error("give the positions of the joints with --joints FILE.csv");
  const std::vector<std::string> inputs = inputs_of(options);
  if (std::ranges::count(inputs, "-") > 1) {
    return usage_error("only one of --joints and --scene can be standard input");
  }
  if (options.srdf == "-") return usage_error("--srdf: standard input is no SRDF; name a file");
  return {};
}

/// Only the balls of links need a device and a folder, and they alone know no tolerance.
Status check_balls_of_links(const ClearanceOptions& options, bool has_bodies) {
  if (options.balls == 0) {
    if (has_bodies) return usage_error("--bodies is about the balls of links: use it with --balls N");
    if (options.decide) return usage_error("--decide is about what balls leave undecided: use it with --balls N");
    if (options.backend == Backend::kVulkan && options.device.empty() && options.resolution == 0) return {};
    return usage_error("--resolution, --backend and --device are about the fit of balls: use them with --balls N");
  }
  if (has_bodies && options.bodies.empty()) return usage_error("--bodies: the name of the folder is empty");
  if (options.bodies == "-") return usage_error("--bodies: '-' is no folder");
  if (options.tolerance > 0 && !options.decide) {
    return usage_error("--balls answers without triangles: it has no --tolerance, except with --decide");
  }
  if (options.backend == Backend::kVulkan || options.device.empty()) return {};
  return usage_error("--device chooses a Vulkan device; it cannot be used with --backend cpu");
}

Status check_clearance_outputs(const ClearanceOptions& options) {
  if (!may_end_in(options.output, ".csv")) {
    return usage_error(fmt::format("--output: '{}' does not end in .csv", options.output));
  }
  if (Status status = check_view_files(options.picture, options.html); !status) return status;
  if (!may_end_in(options.write_srdf, ".srdf")) {
    return usage_error(fmt::format("--write-srdf: '{}' does not end in .srdf", options.write_srdf));
  }
  for (const std::string& input : inputs_of(options)) {
    if (Status status = check_outputs_differ(outputs_of(options), input); !status) return status;
  }
  return {};
}

}  // namespace

GroupOptions group_options(const ClearanceOptions& options) {
  GroupOptions of_library;
  of_library.exact = options.balls == 0;
  of_library.tolerance = options.tolerance;
  of_library.limit = options.limit;
  return of_library;
}

GroupOptions triangle_options(const ClearanceOptions& options) {
  GroupOptions of_library = group_options(options);
  of_library.exact = true;
  return of_library;
}

std::vector<NamedOutput> outputs_of(const ClearanceOptions& options) {
  return {{"--output", &options.output},
          {"--write-srdf", &options.write_srdf},
          {"--picture", &options.picture},
          {"--html", &options.html}};
}

std::vector<std::string> inputs_of(const ClearanceOptions& options) {
  std::vector<std::string> inputs = options.scenes;
  for (const std::string* file : {&options.robot, &options.joints, &options.srdf}) {
    if (!file->empty()) inputs.push_back(*file);
  }
  return inputs;
}

/// The application writes to the options, so both stay together and do not move.
struct ClearanceOptionParser::Declared {
  ReusableApp app;
  ClearanceOptions options;
  ViewChoice view;
};

ClearanceOptionParser::ClearanceOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_clearance(declared_->app, declared_->options, declared_->view);
}

ClearanceOptionParser::~ClearanceOptionParser() = default;

Result<ClearanceOptions> ClearanceOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  ClearanceOptions& options = declared_->options = ClearanceOptions();
  declared_->view = ViewChoice();
  if (Status status = parse_arguments(declared_->app, arguments, "one robot at a time"); !status) {
    return status.error();
  }
  if (options.help) return options;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (Status status = check_clearance_inputs(options); !status) return status.error();
  const bool has_bodies = declared_->app.count("--bodies") > 0;
  if (Status status = check_balls_of_links(options, has_bodies); !status) return status.error();
  if (Status status = take_view(declared_->view, !options.picture.empty() || !options.html.empty(), options.view);
      !status) {
    return status.error();
  }
  if (Status status = check_row(options.row, options.picture, options.html); !status) return status.error();
  if (options.output.empty()) options.output = "-";
  if (Status status = check_clearance_outputs(options); !status) return status.error();
  return options;
}

Result<ClearanceOptions> parse_clearance_options(const std::vector<std::string>& arguments) {
  return ClearanceOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
