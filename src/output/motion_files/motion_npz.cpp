#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "output/motion_files/motion_files.h"
#include "output/numpy_files/npz_writer.h"

namespace medial_vk {
namespace {

/// One number per frame.
template <class Of>
void add_column(NpzWriter& out, const char* name, const MotionRecord& record, const Of& of) {
  std::vector<double> values;
  for (const FollowedFrame& frame : record.frames) values.push_back(of(frame));
  out.numbers<double>(name, {values.size()}, values);
}

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

void add_inside_columns(NpzWriter& out, const MotionRecord& record) {
  add_column(out, "solid_volume", record,
             [&](const FollowedFrame& frame) { return record.has_volume ? frame.measures.solid_volume : kNoNumber; });
  add_column(out, "ball_volume", record, [](const FollowedFrame& frame) { return frame.measures.ball_volume; });
  add_column(out, "outside_bound", record, [](const FollowedFrame& frame) { return frame.measures.outside_bound; });
  if (record.estimates_outside) {
    add_column(out, "outside_estimate", record,
               [](const FollowedFrame& frame) { return frame.outside ? frame.outside->volume : kNoNumber; });
    add_column(out, "outside_error", record,
               [](const FollowedFrame& frame) { return frame.outside ? frame.outside->standard_error : kNoNumber; });
  }
  add_column(out, "gap_lower", record,
             [](const FollowedFrame& frame) { return frame.gap ? frame.gap->lower : kNoNumber; });
  add_column(out, "gap_upper", record,
             [](const FollowedFrame& frame) { return frame.gap ? frame.gap->upper : kNoNumber; });
}

void add_cover_columns(NpzWriter& out, const MotionRecord& record) {
  add_column(out, "solid_volume", record, [&](const FollowedFrame& frame) {
    return record.has_volume ? frame.cover->measures.solid_volume : kNoNumber;
  });
  add_column(out, "ball_volume", record, [](const FollowedFrame& frame) { return frame.cover->measures.ball_volume; });
  add_column(out, "reach_out_bound", record,
             [](const FollowedFrame& frame) { return frame.cover->reach_out_bound.value_or(kNoNumber); });
  std::string proved;
  for (const FollowedFrame& frame : record.frames) proved += static_cast<char>(frame.cover->proved);
  out.add("proved", "|u1", {record.frames.size()}, proved);
}

}  // namespace

Result<std::string> encode_motion_npz(const MotionRecord& record) {
  const std::size_t frames = record.frames.size(), balls = record.frames.front().balls.size();
  std::string numbers, states, origins;
  numbers.reserve(frames * balls * 4 * sizeof(double));
  for (const FollowedFrame& frame : record.frames) {
    for (const Ball& ball : frame.balls) {
      for (const double x : ball.centre) append_little_endian(numbers, x);
      append_little_endian(numbers, ball.radius);
    }
    for (const std::uint8_t state : state_numbers(frame)) states += static_cast<char>(state);
    for (const FollowOrigin origin : frame.origins) origins += static_cast<char>(origin);
  }
  NpzWriter out;
  out.add("balls", kNumpyType<double>, {frames, balls, 4}, numbers);
  out.add("states", "|u1", {frames, balls}, states);
  if (record.renews) out.add("origins", "|u1", {frames, balls}, origins);
  add_column(out, "time", record, [](const FollowedFrame& frame) { return frame.time; });
  if (record.covers) {
    add_cover_columns(out, record);
  } else {
    add_inside_columns(out, record);
  }
  out.number("frames_per_second", record.frames_per_second);
  out.text("rule", record.rule);
  out.text("version", record.version);
  return out.finish();
}

}  // namespace medial_vk
