#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "output/motion_files/motion_files.h"

namespace medial_vk {
namespace {

/// A value of RFC 4180: quoted if it holds a character with a meaning there.
std::string csv_value(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string number_or_nothing(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

std::string volumes(const MotionRecord& record, const FollowedFrame& frame) {
  const FollowMeasures& m = frame.measures;
  if (!record.has_volume) return fmt::format(",{},,{}", m.ball_volume, m.outside_bound);
  return fmt::format("{},{},{},{}", m.solid_volume, m.ball_volume, number_or_nothing(frame.uncovered_percent()),
                     m.outside_bound);
}

}  // namespace

std::string encode_motion_csv(const MotionRecord& record) {
  std::string csv =
      "frame,name,time,solid_volume,ball_volume,uncovered_percent,outside_bound,gap_lower,gap_upper,medial,flat,shrunk,"
      "lost";
  csv += record.renews ? ",renewed\n" : "\n";
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const FollowedFrame& frame = record.frames[i];
    csv += fmt::format("{},{},{},{}", i, csv_value(frame.name), frame.time, volumes(record, frame));
    csv += frame.gap ? fmt::format(",{},{}", frame.gap->lower, frame.gap->upper) : ",,";
    for (const FollowState state :
         {FollowState::kMedial, FollowState::kFlat, FollowState::kShrunk, FollowState::kLost}) {
      csv += fmt::format(",{}", std::ranges::count(frame.states, state));
    }
    if (record.renews) csv += fmt::format(",{}", frame.renewed());
    csv += '\n';
  }
  return csv;
}

}  // namespace medial_vk
