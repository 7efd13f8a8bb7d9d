#include "cli/spheres/body_summary.h"

#include <fmt/format.h>

#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"

namespace medial_vk::cli {
namespace {

/// The number of balls, and an upper bound of the distance that they leave or reach out, which is proved.
std::string set_text(const SphereFit& fit, double greatest, const char* what) {
  return fmt::format("{}; at most {:.4g} {} ({:.3g} % of the diagonal)",
                     counted(fit.levels.back().size(), "sphere", "spheres"), greatest, what,
                     100 * greatest / fit.measures.diagonal);
}

}  // namespace

std::string body_opening(const SpheresOptions& options, const MeshReport& report,
                         const std::optional<DeviceDescription>& device) {
  std::string text = fmt::format("{}: {}\n", options.input == "-" ? "standard input" : options.input,
                                 counted(report.triangles, "triangle", "triangles"));
  for (const std::string& assumption : report.assumptions) text += labelled("note", assumption);
  if (!device) return text + labelled("device", "CPU reference, double precision");
  return text + labelled("device", fmt::format("{} ({}), {}", device->name, device->type, device->driver));
}

std::string body_summary(const SpheresOptions& options, const SphereFit& inside, const SphereFit& cover,
                         const std::vector<StageTime>& times, std::span<const OutputFile> files) {
  std::string text = labelled(
      "inside", set_text(inside, inside.measures.distances.boundary_to_balls.upper, "from the surface to the spheres"));
  text += labelled("cover",
                   set_text(cover, cover.measures.distances.balls_to_solid.upper, "from the spheres to the solid"));
  text += labelled("proved", "no sphere inside reaches out, and the cover leaves no point of the solid out");
  text += labelled("time", times_text(times, options.verbose));
  return text + written_text(files);
}

}  // namespace medial_vk::cli
