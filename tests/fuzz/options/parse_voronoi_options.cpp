// The command line of `medial-vk voronoi`, one argument per line: options that keep their ranges and are consistent, or
// a clear message.
#include <cmath>

#include "cli/options/voronoi/voronoi_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_coordinates(const Point& p) {
  for (const double x : p) require(std::fabs(x) <= 1e150, "coordinates keep their range");
}

void require_usable(const cli::VoronoiCommandOptions& options) {
  const std::size_t sites =
      options.files.size() + options.points.size() + options.segments.size() + options.triangles.size();
  require(sites >= 2 || (options.split && !options.files.empty()), "there are two sites");
  require(!options.output.empty(), "there is an output");
  require(options.resolution >= 1 && options.resolution <= 2048, "--resolution keeps its range");
  require(options.margin >= 0 && options.margin <= 1e150, "--margin keeps its range");
  require(options.threads <= 1024, "--threads keeps its range");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  require(options.from.has_value() == options.to.has_value(), "--from and --to come together");
  require(!options.from || !options.roadmap.empty(), "a path is on a roadmap");
  require(!options.in_plane || sites == options.files.size(), "sites of the plane are files");
  require(!options.in_plane || !options.from || (*options.from)[2] == 0, "places in the plane have two numbers");
  for (const Point& p : options.points) require_coordinates(p);
  for (const auto& segment : options.segments) {
    for (const Point& p : segment) require_coordinates(p);
  }
  for (const auto& triangle : options.triangles) {
    for (const Point& p : triangle) require_coordinates(p);
  }
  const cli::SitesFormat of_stream = options.in_plane ? cli::SitesFormat::kJson : cli::SitesFormat::kPly;
  require(options.output != "-" || options.format() == of_stream, "standard output has one format");
  for (const cli::NamedOutput& output : cli::outputs_of(options)) {
    for (const std::string& file : options.files) {
      require(output.file->empty() || *output.file == "-" || *output.file != file, "no input is overwritten");
    }
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::VoronoiOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::VoronoiCommandOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_voronoi_options(words));
  return 0;
}
