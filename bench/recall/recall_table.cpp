#include "recall_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace medial_vk::bench {
namespace {

/// All rows of a mesh at a resolution: one line of a table, one column for each threshold.
using Line = std::vector<const RecallRow*>;

std::vector<Line> lines_of(const std::vector<RecallRow>& rows, Mode mode) {
  std::vector<Line> lines;
  for (const RecallRow& row : rows) {
    if (row.mode != mode) continue;
    const bool same =
        !lines.empty() && lines.back()[0]->mesh == row.mesh && lines.back()[0]->resolution == row.resolution;
    if (!same) lines.emplace_back();
    lines.back().push_back(&row);
  }
  return lines;
}

/// Prints 1234567 as 1,234,567.
std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

std::string missed_of(const Tally& tally) {
  return tally.samples == 0 ? "–" : fmt::format("{} of {}", grouped(tally.missed()), grouped(tally.samples));
}

/// Rounded up in the last place: only a share of 0 prints as 0.
std::string percent(std::uint64_t part, std::uint64_t whole) {
  if (part == 0 || whole == 0) return "0";
  return fmt::format("{:.2f} %", std::ceil(1e4 * static_cast<double>(part) / static_cast<double>(whole)) / 100);
}

void add_header(std::string& out, const std::vector<std::string>& columns) {
  out += fmt::format("| {} |\n|", fmt::join(columns, " | "));
  for (std::size_t i = 0; i < columns.size(); ++i) out += "---|";
  out += "\n";
}

void add_recall(std::string& out, const std::vector<Line>& lines, const std::vector<double>& angles) {
  std::vector<std::string> columns = {"mesh", "resolution"};
  for (const double angle : angles) {
    columns.push_back(fmt::format("{}: wide", angle));
    columns.push_back(fmt::format("{}: narrow", angle));
  }
  add_header(out, columns);
  for (const Line& line : lines) {
    out += fmt::format("| {} | {} |", line[0]->mesh, line[0]->resolution);
    for (const RecallRow* row : line) {
      out += fmt::format(" {} | {} |", missed_of(row->of(kWide)), missed_of(row->of(kNarrow)));
    }
    out += "\n";
  }
}

void add_by_angle(std::string& out, const std::vector<Line>& lines, const std::vector<double>& angles) {
  std::vector<std::string> columns = {"threshold"};
  for (std::size_t bin = 0; bin < kAngleBins; ++bin) {
    columns.push_back(bin == 0                ? fmt::format("below {}", kAngleEdges[1])
                      : bin + 1 == kAngleBins ? fmt::format("{} and more", kAngleEdges[bin])
                                              : fmt::format("{} to {}", kAngleEdges[bin], kAngleEdges[bin + 1]));
  }
  add_header(out, columns);
  for (const double angle : angles) {
    std::array<Tally, kAngleBins> sums;
    for (const Line& line : lines) {
      for (const RecallRow* row : line) {
        if (row->angle != angle) continue;
        for (const auto& bins : row->recall) {
          for (std::size_t bin = 0; bin < kAngleBins; ++bin) sums[bin] += bins[bin];
        }
      }
    }
    out += fmt::format("| {} |", angle);
    for (const Tally& sum : sums) out += fmt::format(" {} |", missed_of(sum));
    out += "\n";
  }
}

void add_undecided(std::string& out, const std::vector<Line>& lines) {
  add_header(out, {"mesh", "resolution", "lost", "voxels visited", "undecided", "near a face", "near the angle",
                   "at the boundary", "other"});
  for (const Line& line : lines) {
    Tally dismissal;
    RecallRow sum;
    bool listed = true;
    for (const RecallRow* row : line) {
      dismissal += row->dismissal;
      listed = listed && row->undecided_listed;
      sum.visited += row->visited;
      sum.undecided += row->undecided;
      for (std::size_t k = 0; k < kUndecidedKinds; ++k) sum.undecided_by_kind[k] += row->undecided_by_kind[k];
    }
    const std::string lost =
        fmt::format("{}{} of {}", listed ? "" : "at most ", grouped(dismissal.lost()), grouped(dismissal.samples));
    out += fmt::format("| {} | {} | {} | {} | {} |", line[0]->mesh, line[0]->resolution, lost, grouped(sum.visited),
                       percent(sum.undecided, sum.visited));
    for (const std::uint64_t count : sum.undecided_by_kind) {
      out += fmt::format(" {} |", listed ? percent(count, sum.visited) : "?");
    }
    out += "\n";
  }
}

}  // namespace

const char* name_of(Mode mode) { return mode == Mode::kCertified ? "certified" : "thesis"; }

std::string to_csv(const std::vector<RecallRow>& rows) {
  std::string out =
      "mesh,mode,resolution,object_angle,radius,angle_from,angle_to,samples,found,undecided,lost,"
      "run_points,run_visited,run_undecided,run_near_face,run_near_angle,run_boundary,run_other,undecided_listed,"
      "dismissal_samples,dismissal_lost\n";
  for (const RecallRow& row : rows) {
    const std::string run = fmt::format("{},{},{},{},{},{},{}", row.points, row.visited, row.undecided,
                                        fmt::join(row.undecided_by_kind, ","), row.undecided_listed ? 1 : 0,
                                        row.dismissal.samples, row.dismissal.lost());
    for (std::size_t radius = 0; radius < kRadiusClasses; ++radius) {
      for (std::size_t bin = 0; bin < kAngleBins; ++bin) {
        const Tally& t = row.recall[radius][bin];
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", row.mesh, name_of(row.mode), row.resolution,
                           row.angle, radius == kNarrow ? "narrow" : "wide", kAngleEdges[bin], kAngleEdges[bin + 1],
                           t.samples, t.found, t.undecided, t.lost(), run);
      }
    }
  }
  return out;
}

std::string to_markdown(const std::vector<RecallRow>& rows, const std::vector<double>& angles) {
  std::string out;
  for (const Mode mode : {Mode::kCertified, Mode::kThesis}) {
    const std::vector<Line> lines = lines_of(rows, mode);
    if (lines.empty()) continue;
    out += fmt::format("### Missed, mode {}\n\n", name_of(mode));
    add_recall(out, lines, angles);
    out += fmt::format("\nAll of them by object angle, mode {}:\n\n", name_of(mode));
    add_by_angle(out, lines, angles);
    out += "\n";
    if (mode != Mode::kCertified) continue;
    out += "### Lost and undecided, mode certified\n\n";
    add_undecided(out, lines);
    out += "\n";
  }
  return out;
}

}  // namespace medial_vk::bench
