#include "output/motion_page/motion_page.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "output/motion_page/embedded_motion.h"
#include "output/motion_page/motion_geometry.h"
#include "output/page/page_parts.h"

namespace medial_vk {
namespace {

using NumbersOfPage = nlohmann::ordered_json;
using page::MotionBox;

/// A number, or null where there is none.
NumbersOfPage number_or_null(double x) { return std::isfinite(x) ? NumbersOfPage(x) : NumbersOfPage(); }

NumbersOfPage inside_numbers(const FollowedFrame& frame, const MotionRecord& record) {
  const double outside = 100 * frame.measures.outside_bound / frame.measures.solid_volume;
  return {{"uncovered", record.has_volume ? number_or_null(frame.uncovered_percent()) : NumbersOfPage()},
          {"outside", record.has_volume ? number_or_null(outside) : NumbersOfPage()},
          {"gap", frame.gap ? NumbersOfPage{frame.gap->lower, frame.gap->upper} : NumbersOfPage()}};
}

NumbersOfPage cover_numbers(const CoveredFrame& cover, const MotionRecord& record) {
  return {{"added", record.has_volume ? number_or_null(cover.added_percent()) : NumbersOfPage()},
          {"reach_out", cover.reach_out_bound ? NumbersOfPage(*cover.reach_out_bound) : NumbersOfPage()},
          {"solid", cover.proved == CoverState::kSolid}};
}

NumbersOfPage numbers_of(const FollowedFrame& frame, const MotionRecord& record) {
  NumbersOfPage numbers = {{"name", frame.short_name}, {"time", number_or_null(frame.time)}};
  numbers.update(frame.cover ? cover_numbers(*frame.cover, record) : inside_numbers(frame, record));
  const std::vector<std::size_t> counts = state_counts(record, frame);
  for (std::size_t i = 0; i < counts.size(); ++i) numbers[state_names(record)[i]] = counts[i];
  if (record.renews) numbers["renewed"] = frame.renewed();
  return numbers;
}

/// The frames that the page draws.
std::vector<std::size_t> shown_of(const MotionRecord& record) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    if (!record.frames[i].vertices.empty()) shown.push_back(i);
  }
  return shown;
}

std::string motion_json(const MotionRecord& record, std::span<const std::size_t> shown, const MotionBox& box,
                        UpAxis up) {
  NumbersOfPage frames = NumbersOfPage::array();
  for (const FollowedFrame& frame : record.frames) frames.push_back(numbers_of(frame, record));
  const NumbersOfPage json = {
      {"version", record.version},
      {"name", record.name},
      {"rule", record.rule},
      {"frames_per_second", number_or_null(record.frames_per_second)},
      {"closed", record.has_volume},
      {"up", axis_name(up)},
      {"scale", box.scale},
      {"lower", box.lower},
      {"upper", box.upper},
      {"vertices", shown.empty() ? 0 : record.frames[shown.front()].vertices.size()},
      {"triangles", record.triangles.size()},
      {"balls", record.frames.empty() ? 0 : record.frames.front().balls.size()},
      {"shown", shown},
      {"frames", frames},
  };
  return json.dump(-1, ' ', false, NumbersOfPage::error_handler_t::replace);
}

void write_shown(std::string& out, const MotionRecord& record, std::span<const std::size_t> shown,
                 const MotionBox& box) {
  page::Block triangles("triangles", record.triangles.size() * 12), vertices("vertices", 0);
  page::Block balls("balls", shown.size() * record.frames[shown.front()].balls.size() * 16), states("states", 0);
  for (const Triangle& triangle : record.triangles) {
    for (const std::uint32_t corner : triangle) triangles.add(corner);
  }
  page::FrameCoder coder;
  for (const std::size_t i : shown) {
    const FollowedFrame& frame = record.frames[i];
    for (const std::uint8_t byte : coder.next(places_in(box, frame.vertices))) vertices.add(byte);
    for (const Ball& ball : frame.balls) {
      for (const float x : record.covers ? ball_around(ball, box) : ball_inside(ball, box)) balls.add(x);
    }
    for (const std::uint8_t state : state_numbers(frame)) states.add(state);
  }
  for (const page::Block* block : {&triangles, &vertices, &balls, &states}) block->write(out);
}

}  // namespace

std::string encode_motion_page(const MotionRecord& record, UpAxis up) {
  const page::Template page = page::split(page::embedded_motion());
  const std::vector<std::size_t> shown = shown_of(record);
  const MotionBox box = page::box_of(record.frames);
  std::string out;
  out.append(page.before_title).append(page::text_in_html(record.name)).append(page.before_data);
  page::write_json(out, "motion", motion_json(record, shown, box, up));
  if (!shown.empty()) write_shown(out, record, shown, box);
  out.append(page.after_data);
  return out;
}

}  // namespace medial_vk
