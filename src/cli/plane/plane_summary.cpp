#include "cli/plane/plane_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "medial_vk/version.h"

namespace medial_vk::cli {
namespace {

std::string axis_text(const PlaneCounts& counts) {
  std::string text =
      fmt::format("{}, {}, {}", counted(counts.branches, "branch", "branches"),
                  counted(counts.junctions, "junction", "junctions"), counted(counts.ends, "end", "ends"));
  if (counts.points > 0) text += ", " + counted(counts.points, "single point", "single points");
  return text;
}

std::string cover_text(const PublishedCover& cover) {
  return fmt::format("{} with {} samples, {} undetermined; can miss object angles up to {:.3g} and radii up to {:.4g}",
                     counted(cover.discs, "disc", "discs"), cover.samples, grouped(cover.undetermined),
                     cover.missed_angle, cover.missed_radius);
}

/// What was left out of the axis that was found.
std::string kept_text(const PlaneRecord& record) {
  std::string text = fmt::format("{} of {} found", axis_text(counts_of(record)), grouped(record.branches_found));
  if (record.longest_excess > 0) {
    text += fmt::format("; no longest path is longer by more than {:.4g}", record.longest_excess);
  }
  return text;
}

bool is_reduced(const PlaneRecord& record) {
  return record.pruning.length > 0 || record.pruning.significance > 0 || record.longest_path;
}

}  // namespace

std::string plane_summary(const PlaneRecord& record, const std::vector<StageTime>& times,
                          std::span<const OutputFile> files, bool verbose) {
  const ShapeReport& shape = record.shape.report;
  std::string text = fmt::format("{}: {}, {}, area {:.6g}, perimeter {:.6g}\n", record.input, record.format,
                                 counted(shape.segments, "segment", "segments"), shape.area, shape.perimeter);
  for (const std::string& assumption : record.assumptions) text += labelled("note", assumption);
  const PlaneCounts counts = counts_of(record);
  text += labelled("axis", is_reduced(record) ? kept_text(record) : axis_text(counts));
  if (record.published) {
    text += labelled("as published", cover_text(*record.published));
  } else {
    text += labelled("length", fmt::format("{:.6g}", counts.length));
  }
  text += labelled("radius", fmt::format("{:.6g} to {:.6g}", counts.least_radius, counts.greatest_radius));
  text += labelled("epsilon", fmt::format("{:.3g}", record.axis.epsilon));
  text += labelled("time", times_text(times, verbose));
  return text + written_text(files, false);
}

std::string plane_report(const PlaneRecord& record, const std::vector<StageTime>& times) {
  const ShapeReport& shape = record.shape.report;
  const PlaneCounts counts = counts_of(record);
  nlohmann::ordered_json report = {{"version", version()},
                                   {"input", record.input},
                                   {"format", record.format},
                                   {"shape",
                                    {{"rings", shape.rings},
                                     {"segments", shape.segments},
                                     {"area", shape.area},
                                     {"perimeter", shape.perimeter},
                                     {"lower", shape.lower},
                                     {"upper", shape.upper},
                                     {"merged_points", shape.merged_points},
                                     {"degenerate_rings", shape.degenerate_rings},
                                     {"crossings", shape.crossings},
                                     {"touching_points", shape.touching_points},
                                     {"inner_segments", shape.inner_segments},
                                     {"fill", name_of(record.fill_rule)},
                                     {"tolerance", shape.tolerance}}},
                                   {"assumptions", record.assumptions},
                                   {"options",
                                    {{"side", name_of(record.options.side)},
                                     {"object_angle", record.options.object_angle},
                                     {"radius", record.options.radius},
                                     {"margin", record.options.margin},
                                     {"prune_length", record.pruning.length},
                                     {"prune_significance", record.pruning.significance},
                                     {"longest_path", record.longest_path},
                                     {"smooth", record.smooth},
                                     {"step", record.step}}},
                                   {"axis",
                                    {{"branches_found", record.branches_found},
                                     {"branches", counts.branches},
                                     {"junctions", counts.junctions},
                                     {"ends", counts.ends},
                                     {"points", counts.points},
                                     {"arcs", record.axis.arcs.size()},
                                     {"length", counts.length},
                                     {"least_radius", counts.least_radius},
                                     {"greatest_radius", counts.greatest_radius},
                                     {"longest_excess", record.longest_excess},
                                     {"epsilon", record.axis.epsilon},
                                     {"cells", record.axis.cells}}}};
  report["options"]["mode"] = record.published ? "thesis" : "certified";
  if (const std::optional<PublishedCover>& cover = record.published) {
    report["published"] = {{"samples", cover->samples},
                           {"discs", cover->discs},
                           {"undetermined", cover->undetermined},
                           {"missed_angle", cover->missed_angle},
                           {"missed_radius", cover->missed_radius}};
  }
  for (const StageTime& time : times) report["seconds"][time.stage] = time.seconds;
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk::cli
