#include <fmt/format.h>

#include <cmath>

#include "common/csv_cell.h"
#include "output/motion_files/motion_files.h"

namespace medial_vk {
namespace {

std::string number_or_nothing(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

std::string inside_numbers(const MotionRecord& record, const FollowedFrame& frame) {
  const FollowMeasures& m = frame.measures;
  const std::string gap = frame.gap ? fmt::format("{},{}", frame.gap->lower, frame.gap->upper) : ",";
  std::string outside = fmt::format("{}", m.outside_bound);
  if (record.estimates_outside) {
    outside += frame.outside ? fmt::format(",{},{}", frame.outside->volume, frame.outside->standard_error) : ",,";
  }
  if (!record.has_volume) return fmt::format(",{},,{},{}", m.ball_volume, outside, gap);
  return fmt::format("{},{},{},{},{}", number_or_nothing(m.solid_volume), m.ball_volume,
                     number_or_nothing(frame.uncovered_percent()), outside, gap);
}

std::string inside_names(const MotionRecord& record) {
  return fmt::format("uncovered_percent,outside_bound,{}gap_lower,gap_upper",
                     record.estimates_outside ? "outside_estimate,outside_error," : "");
}

std::string cover_numbers(const MotionRecord& record, const CoveredFrame& cover) {
  const CoverFollowMeasures& m = cover.measures;
  const std::string reach = cover.reach_out_bound ? fmt::format("{}", *cover.reach_out_bound) : std::string();
  const char* const proved = cover.proved == CoverState::kSolid ? "solid" : "surface";
  if (!record.has_volume) return fmt::format(",{},,{},{}", m.ball_volume, reach, proved);
  return fmt::format("{},{},{},{},{}", number_or_nothing(m.solid_volume), m.ball_volume,
                     number_or_nothing(cover.added_percent()), reach, proved);
}

}  // namespace

std::string encode_motion_csv(const MotionRecord& record) {
  std::string csv = "frame,name,time,solid_volume,ball_volume,";
  csv += record.covers ? "added_percent,reach_out_bound,proved" : inside_names(record);
  for (const char* const state : state_names(record)) csv += fmt::format(",{}", state);
  csv += record.renews ? ",renewed\n" : "\n";
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const FollowedFrame& frame = record.frames[i];
    csv += fmt::format("{},{},{},{}", i, csv_cell(frame.name), frame.time,
                       frame.cover ? cover_numbers(record, *frame.cover) : inside_numbers(record, frame));
    for (const std::size_t count : state_counts(record, frame)) csv += fmt::format(",{}", count);
    if (record.renews) csv += fmt::format(",{}", frame.renewed());
    csv += '\n';
  }
  return csv;
}

}  // namespace medial_vk
