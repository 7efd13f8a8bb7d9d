#include "cli/options/plane/plane_options.h"

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

constexpr double kGreatestPlaneLength = 1e150;  // as of coordinates
// Shorter steps make more points than a file should have.
constexpr double kLeastStep = 1e-9;

/// Lengths as they were given, beside what they mean.
struct LengthTexts {
  std::string radius, margin, flatness, prune_length, prune_significance, smooth, step;
};

std::string default_plane_output(const std::string& shape) {
  return (shape == "-" ? std::string("stdin") : platform::stem_of(shape)) + ".axis.json";
}

void declare_plane(CLI::App& app, PlaneCommandOptions& options, LengthTexts& lengths) {
  Declarations add(app);
  add.text("SHAPE", "file", options.shape);
  add.text("--slice", "plane", options.slice);
  add.text("-o,--output", "file", options.output);
  add.text("--picture", "file", options.picture);
  add.text("--html", "file", options.html);
  add.text("--report", "file", options.report);
  add.real("--object-angle", {0, std::numbers::pi / 2, false}, " radians", options.object_angle);
  add.text("--radius", "length", lengths.radius);
  add.choice<PlaneSide>("--side",
                        {{"inside", PlaneSide::kInside}, {"outside", PlaneSide::kOutside}, {"both", PlaneSide::kBoth}},
                        options.side);
  add.text("--margin", "length", lengths.margin);
  add.choice<FillRule>("--fill", {{"nonzero", FillRule::kNonZero}, {"evenodd", FillRule::kEvenOdd}}, options.fill);
  add.text("--flatness", "length", lengths.flatness);
  add.text("--prune-length", "length", lengths.prune_length);
  add.text("--prune-significance", "length", lengths.prune_significance);
  add.flag("--longest-path", options.longest_path);
  add.text("--smooth", "length", lengths.smooth);
  add.text("--step", "length", lengths.step);
  add.choice<PlaneColour>("--colour", {{"radius", PlaneColour::kRadius}, {"angle", PlaneColour::kAngle}},
                          options.colour);
  add.choice<PlaneMode>("--mode", {{"certified", PlaneMode::kCertified}, {"thesis", PlaneMode::kThesis}}, options.mode);
  add.flag("--check", options.check);
  add.whole("--threads", 0, 1024, " threads", options.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status take_lengths(const LengthTexts& texts, PlaneCommandOptions& options) {
  struct Given {
    const char* option;
    const std::string& text;
    PlaneLength& length;
  };
  const Given all[] = {{"--radius", texts.radius, options.radius},
                       {"--margin", texts.margin, options.margin},
                       {"--flatness", texts.flatness, options.flatness},
                       {"--prune-length", texts.prune_length, options.prune_length},
                       {"--prune-significance", texts.prune_significance, options.prune_significance},
                       {"--smooth", texts.smooth, options.smooth},
                       {"--step", texts.step, options.step}};
  for (const Given& given : all) {
    if (given.text.empty()) continue;
    const Result<PlaneLength> length = parse_length(given.text, kGreatestPlaneLength, " (units of the shape)");
    if (!length) return usage_error(fmt::format("{}: {}", given.option, length.error().message));
    given.length = length.value();
  }
  return {};
}

Status check_plane_lengths(const LengthTexts& texts, const PlaneCommandOptions& options) {
  if (options.side == PlaneSide::kInside && !texts.margin.empty()) {
    return usage_error("--margin is about the outside: use it with --side outside or --side both");
  }
  if (!texts.flatness.empty() && options.flatness.is_share) {
    return usage_error("--flatness is in units of the file, without %");
  }
  if (!texts.flatness.empty() && !(options.flatness.value > 0)) return usage_error("--flatness must be more than 0");
  if (!texts.smooth.empty() && options.smooth.value > 0 && options.smooth.is_share &&
      options.smooth.value < kLeastStep) {
    return usage_error(fmt::format("--smooth is less than {:g} % of the longest side", 100 * kLeastStep));
  }
  if (!(options.step.value > 0) || (options.step.is_share && options.step.value < kLeastStep)) {
    return usage_error(fmt::format("--step is less than {:g} % of the longest side", 100 * kLeastStep));
  }
  return {};
}

/// As published, the axis is points without branches, inside.
Status check_plane_mode(const PlaneCommandOptions& options) {
  if (options.mode != PlaneMode::kThesis) return {};
  if (options.side != PlaneSide::kInside) return usage_error("--mode thesis searches the inside only");
  if (options.prune_length.value > 0 || options.prune_significance.value > 0 || options.longest_path ||
      options.smooth.value > 0) {
    return usage_error(
        "--mode thesis gives points: --prune-length, --prune-significance, --longest-path and --smooth "
        "are about branches");
  }
  if (options.check) return usage_error("--check is about the exact axis: --mode thesis can miss points");
  return {};
}

Status check_plane_files(const PlaneCommandOptions& options) {
  const std::string extension = file_extension(options.output);
  if (options.output != "-" && extension != ".json" && extension != ".geojson" && extension != ".svg" &&
      extension != ".csv") {
    return usage_error(fmt::format("--output: '{}' ends in none of .json, .geojson, .svg and .csv", options.output));
  }
  if (!may_end_in(options.report, ".json")) {
    return usage_error(fmt::format("--report: '{}' does not end in .json", options.report));
  }
  if (Status status = check_view_files(options.picture, options.html); !status) return status;
  return check_outputs_differ(outputs_of(options), options.shape);
}

}  // namespace

PlaneFormat PlaneCommandOptions::format() const {
  const std::string extension = file_extension(output);
  if (extension == ".geojson") return PlaneFormat::kGeoJson;
  if (extension == ".svg") return PlaneFormat::kSvg;
  return extension == ".csv" ? PlaneFormat::kCsv : PlaneFormat::kJson;
}

std::vector<NamedOutput> outputs_of(const PlaneCommandOptions& options) {
  return {{"--output", &options.output},
          {"--picture", &options.picture},
          {"--html", &options.html},
          {"--report", &options.report}};
}

/// The application writes to the options, so both stay together and do not move.
struct PlaneOptionParser::Declared {
  ReusableApp app;
  PlaneCommandOptions options;
  LengthTexts lengths;
};

PlaneOptionParser::PlaneOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_plane(declared_->app, declared_->options, declared_->lengths);
}

PlaneOptionParser::~PlaneOptionParser() = default;

Result<PlaneCommandOptions> PlaneOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  PlaneCommandOptions& options = declared_->options = PlaneCommandOptions();
  declared_->lengths = LengthTexts();
  if (Status status = parse_arguments(declared_->app, arguments, "one shape at a time"); !status) {
    return status.error();
  }
  if (options.help) return options;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (options.shape.empty()) return usage_error("give a file with a shape, or a mesh with --slice z=HEIGHT");
  if (Status status = take_lengths(declared_->lengths, options); !status) return status.error();
  if (Status status = check_plane_lengths(declared_->lengths, options); !status) return status.error();
  if (!options.slice.empty() && options.flatness.value > 0) {
    return usage_error("--flatness is about curves of SVG: a slice has none");
  }
  if (Status status = check_plane_mode(options); !status) return status.error();
  if (options.output.empty()) options.output = default_plane_output(options.shape);
  if (Status status = check_plane_files(options); !status) return status.error();
  return options;
}

Result<PlaneCommandOptions> parse_plane_options(const std::vector<std::string>& arguments) {
  return PlaneOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
