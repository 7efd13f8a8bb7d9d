#include "cli/options/voronoi/voronoi_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "cli/options/declarations.h"
#include "common/file_extension.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

constexpr double kGreatestSiteLength = 1e150;  // as of coordinates
constexpr std::uint64_t kMostSiteVoxels = 2048;

/// Coordinates as they were given, and whether options were that have a default.
struct CoordinateTexts {
  std::vector<std::string> points, segments, triangles;
  std::string from, to;
  bool has_from = false, has_to = false, has_resolution = false;
};

bool is_shape_file(const std::string& file) {
  const std::string extension = file_extension(file);
  return extension == ".svg" || extension == ".geojson" || extension == ".wkt" || extension == ".csv";
}

/// Numbers with commas between them: those of places in space, or in the plane, of which the third number is 0.
template <std::size_t kCount, std::size_t kDimensions = 3>
Result<std::array<Point, kCount>> parse_places(const char* option, const std::string& text) {
  constexpr std::size_t kNumbers = kDimensions * kCount;
  std::array<Point, kCount> places = {};
  std::size_t begin = 0, count = 0;
  while (begin <= text.size() && count < kNumbers) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const Result<double> number =
        parse_real(text.substr(begin, end - begin), {-kGreatestSiteLength, kGreatestSiteLength, true}, "");
    if (!number) return usage_error(fmt::format("{}: {}", option, number.error().message));
    places[count / kDimensions][count % kDimensions] = number.value();
    ++count;
    begin = end + 1;
  }
  if (count < kNumbers || begin <= text.size()) {
    return usage_error(fmt::format("{}: '{}' is not {} numbers with commas between them", option, text, kNumbers));
  }
  return places;
}

template <std::size_t kCount, class Target>
Status take_places(const char* option, const std::vector<std::string>& texts, std::vector<Target>& targets) {
  for (const std::string& text : texts) {
    const Result<std::array<Point, kCount>> places = parse_places<kCount>(option, text);
    if (!places) return places.error();
    if constexpr (kCount == 1) {
      targets.push_back(places.value()[0]);
    } else {
      targets.push_back(places.value());
    }
  }
  return {};
}

Status take_end(const char* option, bool is_given, bool in_plane, const std::string& text,
                std::optional<Point>& target) {
  if (!is_given) return {};
  const Result<std::array<Point, 1>> place =
      in_plane ? parse_places<1, 2>(option, text) : parse_places<1>(option, text);
  if (!place) return place.error();
  target = place.value()[0];
  return {};
}

Status take_coordinates(const CoordinateTexts& texts, VoronoiCommandOptions& options) {
  if (Status status = take_places<1>("--point", texts.points, options.points); !status) return status;
  if (Status status = take_places<2>("--segment", texts.segments, options.segments); !status) return status;
  if (Status status = take_places<3>("--triangle", texts.triangles, options.triangles); !status) return status;
  const bool in_plane = std::ranges::any_of(options.files, is_shape_file);
  if (Status status = take_end("--from", texts.has_from, in_plane, texts.from, options.from); !status) return status;
  return take_end("--to", texts.has_to, in_plane, texts.to, options.to);
}

void declare_voronoi(CLI::App& app, VoronoiCommandOptions& options, CoordinateTexts& texts, ViewChoice& view) {
  Declarations add(app);
  // One value for each time that the option is given: what follows may be the name of a file.
  const auto add_places = [&](const char* name, std::vector<std::string>& targets) {
    app.add_option(name, targets)->type_name("numbers")->allow_extra_args(false);
  };
  add.texts("SITE", "files", options.files);
  add_places("--point", texts.points);
  add_places("--segment", texts.segments);
  add_places("--triangle", texts.triangles);
  add.flag("--split", options.split);
  add.text("-o,--output", "file", options.output);
  add.flag("--ascii", options.ascii);
  add.text("--picture", "file", options.picture);
  add.view("--view", view);
  add.up("--up", options.picture_options.view.up);
  add.size("--size", options.picture_options.size);
  add.text("--html", "file", options.html);
  add.text("--report", "file", options.report);
  add.text("--roadmap", "file", options.roadmap);
  add.text("--from", "numbers", texts.from);
  add.text("--to", "numbers", texts.to);
  add.whole("--resolution", 1, kMostSiteVoxels, " voxels", options.resolution);
  add.real("--margin", {0, kGreatestSiteLength, true}, " (units of the sites)", options.margin);
  add.flag("--check", options.check);
  add.whole("--threads", 0, 1024, " threads", options.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

/// Whether the sites are in space or in the plane, and that they are not of both.
Status choose_dimension(const CoordinateTexts& texts, VoronoiCommandOptions& options) {
  const auto shapes = std::ranges::count_if(options.files, is_shape_file);
  options.in_plane = shapes > 0;
  if (!options.in_plane) return {};
  if (static_cast<std::size_t>(shapes) < options.files.size()) {
    return usage_error("sites are either meshes or shapes in the plane (.svg, .geojson, .wkt, .csv)");
  }
  const bool has_spatial = !options.points.empty() || !options.segments.empty() || !options.triangles.empty();
  if (has_spatial) return usage_error("--point, --segment and --triangle are sites in space, not in the plane");
  if (options.split || options.ascii || texts.has_resolution) {
    return usage_error("--split, --ascii and --resolution are about sites in space");
  }
  return {};
}

Status check_site_files(const VoronoiCommandOptions& options) {
  const std::string extension = file_extension(options.output);
  const std::vector<std::string> known =
      options.in_plane ? std::vector<std::string>{".json", ".geojson", ".svg", ".csv"}
                       : std::vector<std::string>{".ply", ".obj", ".glb", ".npz", ".csv", ".json"};
  if (options.output != "-" && std::ranges::find(known, extension) == known.end()) {
    return usage_error(fmt::format("--output: '{}' ends in none of {}", options.output, fmt::join(known, ", ")));
  }
  if (options.ascii && options.format() != SitesFormat::kPly) return usage_error("--ascii is about .ply");
  const std::pair<const char*, const std::string*> of_json[] = {{"--report", &options.report},
                                                                {"--roadmap", &options.roadmap}};
  for (const auto& [option, file] : of_json) {
    if (!may_end_in(*file, ".json")) {
      return usage_error(fmt::format("{}: '{}' does not end in .json", option, *file));
    }
  }
  if (Status status = check_view_files(options.picture, options.html); !status) return status;
  for (const std::string& file : options.files) {
    if (Status status = check_outputs_differ(outputs_of(options), file); !status) return status;
  }
  return check_outputs_differ(outputs_of(options), {});
}

std::string default_sites_output(const VoronoiCommandOptions& options) {
  std::string stem = "sites";
  if (!options.files.empty()) {
    stem = options.files[0] == "-" ? std::string("stdin") : platform::stem_of(options.files[0]);
  }
  return stem + (options.in_plane ? ".voronoi.json" : ".voronoi.ply");
}

}  // namespace

SitesFormat VoronoiCommandOptions::format() const {
  const std::string extension = file_extension(output);
  if (extension == ".json") return SitesFormat::kJson;
  if (extension == ".csv") return SitesFormat::kCsv;
  if (in_plane) {
    if (extension == ".geojson") return SitesFormat::kGeoJson;
    return extension == ".svg" ? SitesFormat::kSvg : SitesFormat::kJson;
  }
  if (extension == ".obj") return SitesFormat::kObj;
  if (extension == ".glb") return SitesFormat::kGlb;
  return extension == ".npz" ? SitesFormat::kNpz : SitesFormat::kPly;
}

std::vector<NamedOutput> outputs_of(const VoronoiCommandOptions& options) {
  return {{"--output", &options.output},
          {"--picture", &options.picture},
          {"--html", &options.html},
          {"--report", &options.report},
          {"--roadmap", &options.roadmap}};
}

/// The application writes to the options, so both stay together and do not move.
struct VoronoiOptionParser::Declared {
  ReusableApp app;
  VoronoiCommandOptions options;
  CoordinateTexts texts;
  ViewChoice view;
};

VoronoiOptionParser::VoronoiOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_voronoi(declared_->app, declared_->options, declared_->texts, declared_->view);
}

VoronoiOptionParser::~VoronoiOptionParser() = default;

Result<VoronoiCommandOptions> VoronoiOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  VoronoiCommandOptions& options = declared_->options = VoronoiCommandOptions();
  declared_->texts = CoordinateTexts();
  declared_->view = ViewChoice();
  if (Status status = parse_arguments(declared_->app, arguments, "files are sites"); !status) return status.error();
  if (options.help) return options;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  declared_->texts.has_from = declared_->app.count("--from") > 0;
  declared_->texts.has_to = declared_->app.count("--to") > 0;
  declared_->texts.has_resolution = declared_->app.count("--resolution") > 0;
  if (Status status = take_coordinates(declared_->texts, options); !status) return status.error();
  const std::size_t given =
      options.files.size() + options.points.size() + options.segments.size() + options.triangles.size();
  if (given < (options.split && !options.files.empty() ? 1u : 2u)) {
    return usage_error("give two sites or more: files, --point, --segment and --triangle");
  }
  if (std::ranges::count(options.files, "-") > 1) return usage_error("standard input is one site, not several");
  if (Status status = choose_dimension(declared_->texts, options); !status) return status.error();
  if (options.from.has_value() != options.to.has_value()) return usage_error("--from and --to are used together");
  if (options.from && options.roadmap.empty()) return usage_error("--from and --to are about --roadmap");
  const bool is_drawn = !options.picture.empty() || !options.html.empty();
  if (Status status = take_view(declared_->view, is_drawn, options.picture_options.view); !status) {
    return status.error();
  }
  if (options.in_plane && options.picture_options != PictureOptions()) {
    return usage_error("--view, --up and --size are about pictures of sites in space");
  }
  if (options.output.empty()) options.output = default_sites_output(options);
  if (Status status = check_site_files(options); !status) return status.error();
  return options;
}

Result<VoronoiCommandOptions> parse_voronoi_options(const std::vector<std::string>& arguments) {
  return VoronoiOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
