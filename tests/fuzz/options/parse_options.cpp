// The command line, one argument per line: options that keep their ranges, or a clear message.
#include <algorithm>
#include <numbers>

#include "cli/options/measures.h"
#include "cli/options/options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_in_range(const cli::Options& options) {
  const ExtractionOptions& p = options.extraction;
  require(p.resolution >= 1 && p.resolution <= 4096, "--resolution keeps its range");
  require(p.object_angle > 0 && p.object_angle < std::numbers::pi / 2, "--object-angle keeps its range");
  require(p.radius >= 0 && p.radius <= 1, "--radius keeps its range");
  require(p.epsilon >= 1e-3 && p.epsilon <= 0.5, "--epsilon keeps its range");
  require(p.extra_levels <= 10, "--extra-levels keeps its range");
  require(options.perturb >= 0 && options.perturb <= 0.1, "--perturb keeps its range");
  require(options.threads <= 1024, "--threads keeps its range");
  require(p.memory_budget == 0 || p.memory_budget >= 64u << 20, "--memory keeps its range");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  require(options.sphere_detail.value_or(0) <= kGreatestSphereDetail, "--sphere-detail keeps its range");
  require(options.thickness_delta > 0 && options.thickness_delta < 0.1, "--thickness-delta keeps its range");
  require(options.thickness_width >= 1e-6 && options.thickness_width <= 1, "--thickness-width keeps its range");
  require(options.min_wall >= 0 && options.min_wall < 1e18, "--min-wall keeps its range");
  require(options.min_gap >= 0 && options.min_gap < 1e18, "--min-gap keeps its range");
  require(options.wall_angle > std::numbers::pi / 4 && options.wall_angle < std::numbers::pi / 2,
          "--wall-angle keeps its range");
  require(options.boundary_edge == 0 || (options.boundary_edge >= 0.001 && options.boundary_edge <= 1),
          "--boundary-edge keeps its range");
  const PictureOptions& look = options.look;
  require(std::ranges::any_of(look.view.towards, [](double x) { return x != 0; }), "--view is a direction");
  require(std::ranges::all_of(look.size, [](std::uint32_t n) { return n <= kGreatestPictureSide; }),
          "--size keeps its range");
  if (options.action != cli::Action::kExtract) return;
  require(!options.margin || (options.margin->of(1) > 0 && options.margin->of(1) <= 1e150), "--margin keeps its range");
  require(!options.margin || options.searches_outside(), "--margin is about the outside");
  require(!options.searches_outside() || p.mode == Mode::kCertified, "mode thesis searches the inside");
  require(!options.mesh.empty(), "there is a mesh");
  require(!options.strokes || look.show == PictureShow::kBoundary, "strokes are on the boundary");
  const cli::MeasuresOfBoundary needed = cli::measures_of(options);
  require(options.boundary.empty() || needed.at_vertices(), "a boundary has something at its vertices");
  require(options.thickness_histogram.empty() || needed.thickness, "a histogram has thickness");
  require(options.thickness_points.empty() || needed.thickness, "a table of points has thickness");
  require(options.needs_walls() || needed.thickness || options.wall_angle == 1.2, "--wall-angle is about walls");
  require(!options.output.empty(), "there is an output");
  require(options.output == "-" || options.output != options.mesh, "the mesh is not overwritten");
  require(options.output != options.report && options.output != options.picture, "results do not replace each other");
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::OptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::Options> options = parser.parse(words);
  if (options.ok()) {
    fuzz::require_in_range(options.value());
  } else {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_options(words));
  return 0;
}
