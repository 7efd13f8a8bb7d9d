#include "cli/spheres/spheres_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "output/charts_and_tables/measures_output.h"

namespace medial_vk::cli {
namespace {

/// A name from a file in a form for the terminal: without control characters.
std::string printable(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return name;
}

std::size_t count_links(const FitsRecord& record) {
  std::set<std::string> links;
  for (const FittedSolid& solid : record.solids) links.insert(solid.link);
  return links.size();
}

std::string where(const SpheresOptions& options, const FitsRecord& record) {
  if (options.backend == Backend::kCpu) return "CPU reference, double precision";
  if (!record.device) return "Vulkan";
  return fmt::format("{} ({}), {}", record.device->name, record.device->type, record.device->driver);
}

std::string description_of(SphereContract contract) {
  switch (contract) {
    case SphereContract::kInside:
      return "inside: no sphere reaches out";
    case SphereContract::kCover:
      return "cover: nothing is left out";
    case SphereContract::kBalanced:
      break;
  }
  return "balanced: as near on both sides as the spheres get";
}

/// The proved property of every set; fit_parts() has required the proofs.
std::string certificate_text(SphereContract contract, const FitsRecord& record) {
  std::uint64_t spheres = 0, triangles = 0;
  bool closed = true;
  double farthest = 0;
  for (const FittedSolid& solid : record.solids) {
    spheres += solid.levels.back().size();  // a sphere that fills a ball needs no proof
    if (!solid.measures) continue;
    triangles += solid.measures->cover.triangles;
    closed &= solid.measures->cover.closed;
    farthest = std::max(farthest, solid.measures->distances.balls_to_solid.upper);
  }
  switch (contract) {
    case SphereContract::kInside:
      return fmt::format("{} with centre inside and radius at most the exact distance{}",
                         counted(spheres, "sphere", "spheres"), closed ? "" : "; the mesh is open: its surface only");
    case SphereContract::kCover:
      if (triangles == 0)
        return fmt::format("{}, each of which is the geometry itself", counted(spheres, "sphere", "spheres"));
      return fmt::format("{} covered piece by piece{}", counted(triangles, "triangle", "triangles"),
                         closed ? ", no hole within" : "; the mesh is open: its surface only");
    case SphereContract::kBalanced:
      break;
  }
  return fmt::format("no sphere reaches out by more than {:.4g}", farthest);
}

/// The greatest of all parts, as proved.
std::string gap_text(const FitsRecord& record) {
  double gap = 0, share = 0;
  for (const FittedSolid& solid : record.solids) {
    if (!solid.measures) continue;
    gap = std::max(gap, solid.measures->distances.boundary_to_balls.upper);
    share = std::max(share, solid.measures->distances.boundary_to_balls.upper / solid.measures->diagonal);
  }
  return fmt::format("at most {:.4g} from the surface to the spheres ({:.3g} % of the diagonal)", gap, 100 * share);
}

/// What SphereFitOptions::max_distance bounds: the greatest of all parts, as proved.
std::string surfaces_text(const FitsRecord& record) {
  double distance = 0, share = 0;
  for (const FittedSolid& solid : record.solids) {
    if (!solid.measures) continue;
    const double upper = solid.measures->distances.between_surfaces().upper;
    distance = std::max(distance, upper);
    share = std::max(share, upper / solid.measures->diagonal);
  }
  return fmt::format("within {:.4g} of each other, in either direction ({:.3g} % of the diagonal)", distance,
                     100 * share);
}

/// The volume between spheres and solids, over that of the solids; none if unknown.
std::optional<std::string> difference_text(SphereContract contract, const FitsRecord& record) {
  double whole = 0, difference = 0, variance = 0;
  for (const FittedSolid& solid : record.solids) {
    if (!solid.measures) continue;  // a ball, which is exact
    const VolumeError& volume = solid.measures->volume;
    whole += volume.solid;
    difference += volume.uncovered + volume.outside;
    variance += 4 * volume.standard_error * volume.standard_error;
  }
  if (!(whole > 0)) return std::nullopt;
  if (variance == 0) {
    return fmt::format("{:.3g} % of the volume is {}", 100 * difference / whole,
                       contract == SphereContract::kCover ? "added" : "uncovered or reaches out");
  }
  return fmt::format("{:.3g} % of the volume, uncovered or reaching out (+- {:.2g} %, standard error)",
                     100 * difference / whole, 100 * std::sqrt(variance) / whole);
}

std::string percent(const std::optional<Share>& share) {
  if (!share) return "-";
  if (!share->is_estimate) return fmt::format("{:.3g} %", 100 * share->value);
  return fmt::format("{:.3g} to {:.3g} %", 100 * share->lower(), 100 * share->upper());
}

/// For the solids of which most is uncovered.
std::string advice_text(const SpheresOptions& options, const FitsRecord& record) {
  constexpr std::size_t kMost = 4;
  std::vector<const FittedSolid*> solids;
  for (const FittedSolid& solid : record.solids) {
    if (solid.advice) solids.push_back(&solid);
  }
  std::ranges::stable_sort(solids, std::greater<>(), [](const FittedSolid* solid) { return solid->advice->uncovered; });
  if (solids.empty()) return {};
  std::string text;
  for (std::size_t i = 0; i < std::min(solids.size(), kMost); ++i) {
    const FittedSolid& solid = *solids[i];
    const FitAdvice& advice = *solid.advice;
    std::string line = options.is_robot ? fmt::format("{}, {}: ", printable(solid.link), printable(solid.name)) : "";
    line += fmt::format("{:.3g} % uncovered; ", 100 * advice.uncovered);
    if (advice.inside > 0)
      line += fmt::format("about {} spheres inside or more leave a quarter; ", grouped(advice.inside));
    text +=
        labelled("advice", line + fmt::format("{} that cover it reach out by {:.3g} and add {:.3g} times its volume",
                                              grouped(solid.proved.size()), advice.reach, advice.added));
  }
  if (solids.size() > kMost) {
    text += labelled("advice", fmt::format("{} more: see --report", solids.size() - kMost));
  }
  const bool by_distance =
      std::ranges::any_of(solids, [](const FittedSolid* solid) { return solid->advice->by_distance; });
  return text +
         labelled("advice", fmt::format("--contract cover --max-reach R for covers (on sheets, half of R takes four "
                                        "times as many spheres){}",
                                        by_distance ? "; --by distance to spread those inside evenly" : ""));
}

double seconds(const FitsRecord& record) {
  double total = 0;
  for (const StageTime& time : record.times) total += time.seconds;
  return total;
}

}  // namespace

CheckReport joint_check(const FitsRecord& record) {
  CheckReport joint;
  for (const FittedSolid& solid : record.solids) {
    if (!solid.check) continue;
    for (const CheckLine& line : solid.check->lines) {
      const auto same = std::ranges::find(joint.lines, line.condition, &CheckLine::condition);
      if (same == joint.lines.end()) {
        joint.lines.push_back(line);
        continue;
      }
      if (same->failed == 0 && line.failed > 0) {
        same->first_failure = fmt::format("{}: {}", printable(solid.link), line.first_failure);
      }
      same->tested += line.tested;
      same->failed += line.failed;
      same->worst = std::max(same->worst, line.worst);
    }
  }
  return joint;
}

std::string spheres_opening(const SpheresOptions& options, const FitsRecord& record) {
  std::uint64_t triangles = 0;
  for (const FittedSolid& solid : record.solids) triangles += solid.report().triangles;
  std::string text = options.input == "-" ? "standard input" : options.input;
  if (!record.part.empty()) text += ": " + record.part;
  if (options.is_robot) {
    text += fmt::format(": {} with {}, {}\n", counted(count_links(record), "link", "links"),
                        counted(record.solids.size(), "geometry", "geometries"),
                        counted(triangles, "triangle", "triangles"));
  } else {
    text += fmt::format(": {}\n", counted(triangles, "triangle", "triangles"));
  }
  for (const FittedSolid& solid : record.solids) {
    for (const std::string& assumption : solid.report().assumptions) {
      text += labelled("note", options.is_robot
                                   ? fmt::format("{}, {}: {}", printable(solid.link), printable(solid.name), assumption)
                                   : assumption);
    }
  }
  return text + labelled("device", where(options, record));
}

std::string spheres_summary(const SpheresOptions& options, const FitsRecord& record,
                            std::span<const OutputFile> files) {
  const SphereFitOptions& fit = options.spheres;
  std::string spheres = grouped(count_spheres(record));
  if (options.spheres.levels) spheres += fmt::format(", in {} levels", record.solids.front().levels.size());
  std::string text = labelled("spheres", spheres);
  text += labelled("contract", description_of(fit.contract));
  text += labelled("certified", certificate_text(fit.contract, record));
  if (const std::optional<Share> error = uncovered_share(record)) {
    text += labelled(
        "error",
        fmt::format("{} of the volume is left uncovered{}", percent(error),
                    error->is_estimate ? "; measured at random points where a mesh is open or crosses itself" : ""));
  }
  if (fit.contract != SphereContract::kInside) {
    const std::optional<std::string> difference = difference_text(fit.contract, record);
    if (difference) text += labelled("error", *difference);
  }
  const double facets = std::ranges::max(record.solids, {}, &FittedSolid::facet_share).facet_share;
  if (facets > 0) {
    const bool contract_is_exact = fit.contract != SphereContract::kBalanced;
    text += labelled("note",
                     fmt::format("Round primitives are {} {:.2g} of their radius{}.",
                                 fit.contract == SphereContract::kCover ? "wrapped in facets that stand off by up to"
                                                                        : "filled with facets that fall short by up to",
                                 facets, contract_is_exact ? "; volumes are those of the true shapes" : ""));
  }
  text += labelled("gap", gap_text(record));
  if (options.spheres.max_distance > 0) text += labelled("surfaces", surfaces_text(record));
  text += advice_text(options, record);
  text += labelled("time", duration(seconds(record)));
  return text + written_text(files);
}

std::string spheres_details(const SpheresOptions& options, const FitsRecord& record) {
  const std::vector<Column> columns = {{"link"}, {"geometry"}, {"spheres", true}, {"uncovered", true}, {"time", true}};
  std::vector<std::vector<std::string>> rows;
  for (const FittedSolid& solid : record.solids) {
    rows.push_back({printable(solid.link), printable(solid.name), grouped(solid.levels.back().size()),
                    percent(uncovered_share(solid, options.spheres.contract)), duration(solid.seconds)});
  }
  std::string text = format_table(columns, rows);
  const FittedSolid& first = record.solids.front();
  if (record.solids.size() == 1 && first.measures) text += measures_text(*first.measures);
  return text;
}

}  // namespace medial_vk::cli
