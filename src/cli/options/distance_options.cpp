#include "cli/options/distance_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "cli/options/declarations.h"
#include "common/file_extension.h"

namespace medial_vk::cli {
namespace {

constexpr double kGreatestLength = 1e30;

void declare_distance(CLI::App& app, DistanceCommandOptions& options, ViewChoice& view) {
  Declarations add(app);
  add.text("A", "file", options.a);
  add.text("B", "file", options.b);
  add.text("--poses", "file", options.poses);
  add.text("-o,--output", "file", options.output);
  add.text("--picture", "file", options.picture);
  add.text("--html", "file", options.html);
  add.row("--row", options.row);
  add.view("--view", view);
  add.up("--up", options.view.up);
  add.real("--tolerance", {0, kGreatestLength, true}, " (units of the mesh)", options.tolerance);
  add.real("--limit", {0, kGreatestLength, true}, " (units of the mesh)", options.limit);
  add.flag("--surfaces", options.surfaces);
  add.flag("--balls", options.balls);
  add.flag("--keep-inner-faces", options.keep_inner_faces);
  add.flag("--check", options.check);
  add.whole("--threads", 0, 1024, " threads", options.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status check_distance_inputs(const DistanceCommandOptions& options) {
  if (options.a.empty() || options.b.empty()) return usage_error("give two meshes or body files, A and B");
  const int streams = (options.a == "-") + (options.b == "-") + (options.poses == "-");
  if (streams > 1) return usage_error("only one of A, B and --poses can be standard input");
  return {};
}

/// Balls alone prove intervals of their own width, and know no surface.
Status check_balls(const DistanceCommandOptions& options) {
  if (!options.balls) return {};
  for (const std::string& file : {options.a, options.b}) {
    if (file_extension(file) == ".npz") continue;
    return usage_error(
        fmt::format("--balls: '{}' is no body file; medial-vk spheres MESH --contract both makes one", file));
  }
  const std::pair<const char*, bool> of_triangles[] = {{"--tolerance", options.tolerance > 0},
                                                       {"--limit", options.limit <= kGreatestLength},
                                                       {"--surfaces", options.surfaces}};
  for (const auto& [name, is_given] : of_triangles) {
    if (is_given) return usage_error(fmt::format("--balls answers without triangles: it has no {}", name));
  }
  return {};
}

Status check_distance_outputs(const DistanceCommandOptions& options) {
  if (!may_end_in(options.output, ".csv")) {
    return usage_error(fmt::format("--output: '{}' does not end in .csv", options.output));
  }
  if (Status status = check_view_files(options.picture, options.html); !status) return status;
  for (const std::string* input : {&options.a, &options.b, &options.poses}) {
    if (input->empty()) continue;
    if (Status status = check_outputs_differ(outputs_of(options), *input); !status) return status;
  }
  return {};
}

}  // namespace

DistanceOptions distance_options(const DistanceCommandOptions& options) {
  DistanceOptions of_library;
  of_library.tolerance = options.tolerance;
  of_library.limit = options.limit;
  of_library.surfaces_only = options.surfaces;
  return of_library;
}

std::vector<NamedOutput> outputs_of(const DistanceCommandOptions& options) {
  return {{"--output", &options.output}, {"--picture", &options.picture}, {"--html", &options.html}};
}

/// The application writes to the options, so both stay together and do not move.
struct DistanceOptionParser::Declared {
  ReusableApp app;
  DistanceCommandOptions options;
  ViewChoice view;
};

DistanceOptionParser::DistanceOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_distance(declared_->app, declared_->options, declared_->view);
}

DistanceOptionParser::~DistanceOptionParser() = default;

Result<DistanceCommandOptions> DistanceOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  DistanceCommandOptions& options = declared_->options = DistanceCommandOptions();
  declared_->view = ViewChoice();
  if (Status status = parse_arguments(declared_->app, arguments, "two meshes or body files, A and B, at a time");
      !status) {
    return status.error();
  }
  if (options.help) return options;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (Status status = check_distance_inputs(options); !status) return status.error();
  if (Status status = check_balls(options); !status) return status.error();
  if (Status status = take_view(declared_->view, !options.picture.empty() || !options.html.empty(), options.view);
      !status) {
    return status.error();
  }
  if (Status status = check_row(options.row, options.picture, options.html); !status) return status.error();
  if (options.output.empty()) options.output = "-";
  if (Status status = check_distance_outputs(options); !status) return status.error();
  return options;
}

Result<DistanceCommandOptions> parse_distance_options(const std::vector<std::string>& arguments) {
  return DistanceOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
