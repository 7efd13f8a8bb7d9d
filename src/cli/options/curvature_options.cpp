#include "cli/options/curvature_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>

#include "cli/options/declarations.h"
#include "common/file_extension.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

constexpr double kGreatestSpacing = 1e18;  // as of the library

/// BALLS-stem.curvature.ply in the current folder; a medial file loses its .medial, too.
std::string default_curvature_output(const std::string& balls) {
  std::filesystem::path stem = platform::path_of(balls == "-" ? "stdin" : balls).stem();
  for (const char* ending : {".medial", ".spheres", ".body"}) {
    if (stem.extension() == ending && stem.has_stem()) {
      stem = stem.stem();
      break;
    }
  }
  return platform::text_of(stem) + ".curvature.ply";
}

void declare_curvature(CLI::App& app, CurvatureCommandOptions& options) {
  Declarations add(app);
  add.text("BALLS", "file", options.balls);
  add.text("-o,--output", "file", options.output);
  add.text("--report", "file", options.report);
  add.choice<CurvatureMethod>("--method", {{"fits", CurvatureMethod::kFits}, {"source", CurvatureMethod::kDifferences}},
                              options.curvature.method);
  add.real("--spacing", {0, kGreatestSpacing, false}, " (units of the balls)", options.curvature.spacing);
  add.real("--step", {2 * std::numbers::sqrt3, 1000, true}, " spacings", options.curvature.step);
  add.flag("--smooth", options.curvature.smooth);
  add.whole("--threads", 0, 1024, " threads", options.curvature.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status check_curvature_command(const CurvatureCommandOptions& options) {
  if (options.balls.empty()) return usage_error("give a file of balls");
  if (options.curvature.method == CurvatureMethod::kFits) {
    const CurvatureOptions usual;
    if (options.curvature.smooth) return usage_error("--smooth is for --method source");
    if (options.curvature.step != usual.step) return usage_error("--step is for --method source");
  }
  const std::string extension = file_extension(options.output);
  if (options.output != "-" && extension != ".csv" && extension != ".ply" && extension != ".npz" &&
      extension != ".json" && extension != ".glb") {
    return usage_error(fmt::format("--output: '{}' ends in none of .csv, .ply, .npz, .json and .glb", options.output));
  }
  if (!may_end_in(options.report, ".json")) {
    return usage_error(fmt::format("--report: '{}' does not end in .json", options.report));
  }
  return check_outputs_differ(outputs_of(options), options.balls);
}

}  // namespace

CurvatureFormat CurvatureCommandOptions::format() const {
  const std::string extension = file_extension(output);
  if (extension == ".ply") return CurvatureFormat::kPly;
  if (extension == ".npz") return CurvatureFormat::kNpz;
  if (extension == ".glb") return CurvatureFormat::kGlb;
  return extension == ".json" ? CurvatureFormat::kJson : CurvatureFormat::kCsv;
}

std::vector<NamedOutput> outputs_of(const CurvatureCommandOptions& options) {
  return {{"--output", &options.output}, {"--report", &options.report}};
}

/// The application writes to the options, so both stay together and do not move.
struct CurvatureOptionParser::Declared {
  ReusableApp app;
  CurvatureCommandOptions options;
};

CurvatureOptionParser::CurvatureOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_curvature(declared_->app, declared_->options);
}

CurvatureOptionParser::~CurvatureOptionParser() = default;

Result<CurvatureCommandOptions> CurvatureOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  CurvatureCommandOptions& options = declared_->options = CurvatureCommandOptions();
  if (Status status = parse_arguments(declared_->app, arguments, "one file of balls at a time"); !status) {
    return status.error();
  }
  if (options.help) return options;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (options.output.empty() && !options.balls.empty()) options.output = default_curvature_output(options.balls);
  if (Status status = check_curvature_command(options); !status) return status.error();
  return options;
}

Result<CurvatureCommandOptions> parse_curvature_options(const std::vector<std::string>& arguments) {
  return CurvatureOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
