#include "cli/extract/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "cli/extract/wall_run.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"

namespace medial_vk::cli {
namespace {

std::string mesh_name(const std::string& path) { return path == "-" ? "standard input" : path; }

std::string describe_mesh(const MeshReport& mesh) {
  return fmt::format("{}, {}, longest side", counted(mesh.triangles, "triangle", "triangles"),
                     mesh.closed ? "closed" : "not closed");
}

std::string where(const RunRecord& record) {
  if (record.backend == Backend::kCpu) return "CPU reference, double precision, one thread";
  if (!record.device) return "Vulkan";
  return fmt::format("{} ({}), {}", record.device->name, record.device->type, record.device->driver);
}

std::string describe_voxels(const RunRecord& record) {
  const ExtractionCounters& counters = record.counters;
  std::string text = fmt::format("{} found", grouped(counters.found));
  if (record.options.mode == Mode::kCertified || counters.undecided > 0) {
    text += fmt::format(", {} undecided", grouped(counters.undecided));
  }
  if (record.certify.rejected > 0) {
    text += fmt::format(" ({} of them rejected by the certificate)", grouped(record.certify.rejected));
  }
  return text;
}

std::string describe_search(const SearchRecord& search) {
  return fmt::format("{}, up to {:.5g} beyond the bounding box", search.inside ? "inside and outside" : "outside",
                     search.margin);
}

std::string describe_points(const RunRecord& record) {
  const SearchRecord& search = record.search;
  std::string text = grouped(record.points);
  if (search.inside && search.outside) {
    text += fmt::format(" ({} inside, {} outside)", grouped(search.inside_points),
                        grouped(record.points - search.inside_points));
  }
  if (record.points == 0 && !search.inside) {
    text += " (none above the thresholds: a convex solid has none outside)";
  } else if (record.points == 0)
    text += " (none above the thresholds; another --resolution, or --perturb, may find some)";
  if (record.simplified > 0) text += fmt::format(" ({} removed by --simplify)", grouped(record.simplified));
  return text;
}

std::string describe_sheets(const Sheets& sheets) {
  std::string text = grouped(sheets.sheets.size());
  if (sheets.fragments > 0) {
    text += fmt::format(" ({} of them with fewer than {} points)", grouped(sheets.fragments), kFragmentPoints);
  }
  return text;
}

std::string describe(const BettiNumbers& betti) {
  return fmt::format("{}, {}, {}", counted(betti.components, "component", "components"),
                     counted(betti.tunnels, "tunnel", "tunnels"), counted(betti.cavities, "cavity", "cavities"));
}

std::string describe_union(const RunRecord& record, const UnionRecord& whole, bool of_inside) {
  std::string text = fmt::format("{:.6g}", whole.volume);
  // An open mesh has no volume to compare with.
  if (of_inside && record.mesh.closed && record.mesh.signed_volume > 0) {
    text += fmt::format(", {:.2f} % of the solid", 100 * whole.volume / record.mesh.signed_volume);
  }
  text += "; " + describe(whole.topology);
  // Small balls at edges of the solid reach no other ball.
  if (whole.leading_components < whole.topology.components) {
    text += fmt::format("; {} of the components hold{} {:g} % of the volume", grouped(whole.leading_components),
                        whole.leading_components == 1 ? "s" : "", 100 * kLeadingShare);
  }
  return text;
}

/// The largest voxels for which the solid is fat: at the object angle of the extraction, and at the first one for which
/// the balls are connected.
std::string describe_fatness(const FatnessRecord& record) {
  const auto for_angle = [](const Fatness& fatness) {
    return fmt::format("voxels up to {:.3g} at object angles from {:.3g} rad{}", fatness.largest_voxel,
                       fatness.object_angle, fatness.proves_connected ? ", whose balls are connected" : "");
  };
  const Fatness& first = record.of_angles.front();
  const auto connected = std::ranges::find_if(record.of_angles, &Fatness::proves_connected);
  if (connected == record.of_angles.end() || first.proves_connected) return for_angle(first);
  return for_angle(first) + "; " + for_angle(*connected);
}

std::string describe_removal(const SheetRemoval& removal) {
  const double left = removal.volume_left.empty() ? 1 : removal.volume_left.back();
  return fmt::format("{} of {} sheets, {:.2f} % of the volume", grouped(removal.kept.size()),
                     grouped(removal.kept.size() + removal.sheets.size()), 100 * left);
}

std::string describe_thickness(const ThicknessRecord& record) {
  std::string text = fmt::format("median {:.4g} to {:.4g} by area", record.median.lower, record.median.upper);
  if (record.least) {
    const Point& at = record.least_at;
    text += fmt::format("; least met in a wall {:.4g} to {:.4g} at {:.4g}, {:.4g}, {:.4g}", record.least->lower,
                        record.least->upper, at[0], at[1], at[2]);
  }
  const double points = static_cast<double>(std::max<std::size_t>(record.intervals.size(), 1));
  const auto percent = [&](ThicknessKind kind) { return 100 * record.share(kind); };
  text += fmt::format("; walls {:.3g} %, creases {:.3g} %, corners {:.3g} %, facets {:.3g} % of the area",
                      percent(ThicknessKind::kWall), percent(ThicknessKind::kCrease), percent(ThicknessKind::kCorner),
                      percent(ThicknessKind::kFacets));
  return text + fmt::format("; wider than {:g} % at {:.3g} %; delta {:.3g}", 100 * kWideInterval,
                            100 * static_cast<double>(record.wide) / points, record.delta);
}

std::string describe_curvature(const CurvatureRecord& record) {
  const auto range = [](const std::optional<CurvatureRecord::Range>& of) {
    return of ? fmt::format("{:.3g} to {:.3g}", of->least, of->greatest) : std::string("unknown");
  };
  std::string reasons;
  for (std::size_t i = static_cast<std::size_t>(CurvatureState::kSeam); i < kCurvatureStates; ++i) {
    if (!(record.state_shares[i] >= 0.0005)) continue;
    const char* const before = reasons.empty() ? " (" : ", ";
    reasons +=
        fmt::format("{}{} {:.3g} %", before, state_name(static_cast<CurvatureState>(i)), 100 * record.state_shares[i]);
  }
  return fmt::format("kappa 1 {}, kappa 2 {}; one of both is known at {:.3g} %, none at {:.3g} % of the area{}",
                     range(record.kappa_1), range(record.kappa_2), 100 * (record.unknown_share - record.none_share),
                     100 * record.none_share, reasons.empty() ? "" : reasons + ")");
}

/// Both sides of the comparison, which shows whether the topology was kept.
std::string describe_medial_mesh(const RunRecord& record) {
  std::string text = fmt::format("{}, Euler characteristic {}", describe(record.medial_mesh->betti),
                                 record.medial_mesh->euler_characteristic);
  if (record.euler_characteristic) text += fmt::format(" (of the solid: {})", *record.euler_characteristic);
  return text;
}

/// Total first, then the significant stages: those of at least a hundredth of it.
std::string describe_times(const std::vector<StageTime>& times) {
  const double total = std::accumulate(times.begin(), times.end(), 0.0,
                                       [](double sum, const StageTime& time) { return sum + time.seconds; });
  std::string stages;
  for (const StageTime& time : times) {
    if (time.seconds < 0.01 * total) continue;
    stages += fmt::format("{}{} {}", stages.empty() ? "" : ", ", time.stage, duration(time.seconds));
  }
  return fmt::format("{} ({})", duration(total), stages);
}

std::string range_text(const std::optional<Range>& range) {
  return range ? fmt::format("{:.5g} to {:.5g}", range->least, range->greatest) : "none";
}

}  // namespace

std::string opening(const RunRecord& record) {
  const std::string part = record.part.empty() ? "" : record.part + ": ";
  std::string text =
      fmt::format("{}: {}{} {:.5g}\n", mesh_name(record.input), part, describe_mesh(record.mesh), record.longest_side);
  for (const std::string& assumption : record.mesh.assumptions) text += labelled("note", assumption);
  if (record.search.outside) text += labelled("side", describe_search(record.search));
  text += labelled("device", where(record));
  if (record.backend == Backend::kVulkan) {
    text += labelled("memory", fmt::format("at most {} of the device's {}", memory_size(record.options.memory_budget),
                                           record.device ? memory_size(record.device->memory_bytes) : "memory"));
  }
  return text;
}

std::string summary(const RunRecord& record, std::span<const OutputFile> files) {
  std::string text = labelled("points", describe_points(record));
  text += labelled("voxels", describe_voxels(record));
  if (record.points > 0) text += labelled("sheets", describe_sheets(record.sheets));
  if (record.ball_union) text += labelled("volume", describe_union(record, *record.ball_union, record.search.inside));
  if (record.outside_union) text += labelled("outside", describe_union(record, *record.outside_union, false));
  if (record.fatness && record.points > 0) text += labelled("fat", describe_fatness(*record.fatness));
  if (record.removal) text += labelled("kept", describe_removal(*record.removal));
  if (record.medial_mesh) text += labelled("mesh", describe_medial_mesh(record));
  if (record.boundary.thickness) text += labelled("thickness", describe_thickness(*record.boundary.thickness));
  if (record.boundary.curvature) text += labelled("curvature", describe_curvature(*record.boundary.curvature));
  for (const WallRecord& walls : record.boundary.walls) {
    text += labelled(walls.side == ThicknessSide::kWalls ? "walls" : "gaps", describe_walls(walls));
  }
  text += labelled("radius", range_text(record.radii));
  text += labelled("time", describe_times(record.host_times));
  return text + written_text(files);
}

std::string details(const RunRecord& record) {
  std::string text = labelled("angle", range_text(record.object_angles) + " rad");
  text += labelled("grid", fmt::format("{} x {} x {} voxels of {:.5g}", record.grid.size[0], record.grid.size[1],
                                       record.grid.size[2], record.grid.voxel_size));
  text += labelled("queries", grouped(record.counters.queries));
  if (!record.picture_drawn_by.empty()) text += labelled("picture", "drawn by " + record.picture_drawn_by);
  if (record.counters.retries > 0) text += labelled("retries", grouped(record.counters.retries));
  for (const StageTime& time : record.device_times) {
    text += labelled("on device", fmt::format("{:<24} {}", time.stage, duration(time.seconds)));
  }
  return text + level_table(record.counters);
}

}  // namespace medial_vk::cli
