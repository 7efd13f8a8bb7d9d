#include "cli/follow/follow_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quoted.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"

namespace medial_vk::cli {
namespace {

/// When balls are chosen anew, and how many were.
std::string renewed_text(const FollowOptions& options, const MotionRecord& record) {
  std::size_t balls = 0, frames = 0, most = 0;
  for (const FollowedFrame& frame : record.frames) {
    balls += frame.renewed();
    frames += frame.renewed() > 0 ? 1 : 0;
    most = std::max(most, frame.renewed());
  }
  const std::string when = fmt::format("beyond {:g} times what is uncovered at rest, in a region or in all",
                                       options.follower.renewal_factor);
  if (frames == 0) return "no ball; " + when;
  return fmt::format("{} times a ball, in {} {}, at most {} in one; {}", grouped(balls), grouped(frames),
                     frames == 1 ? "frame" : "frames", grouped(most), when);
}

std::string rule_text(const FollowOptions& options) {
  const char* const steps = options.follower.steps == 1 ? "step" : "steps";
  if (options.covers()) {
    return fmt::format("cover: a ball moves with its part of the surface; {} {} towards less volume{}",
                       options.follower.steps, steps, options.tighten ? "; divided anew in each frame" : "");
  }
  std::string text = options.follower.rule == FollowRule::kPublished
                         ? "published: one contact, balls may reach out"
                         : fmt::format("tangent: two contacts, inside in every frame; {} {} towards more volume",
                                       options.follower.steps, steps);
  return options.from_rest ? text + "; each frame from rest" : text;
}

/// At rest, on average and at most, as per cent of the solid; frames whose volume is not known are left out.
std::string error_text(const MotionRecord& record) {
  double sum = 0, most = 0;
  std::size_t count = 0;
  const FollowedFrame* worst = nullptr;
  for (const FollowedFrame& frame : record.frames) {
    const double percent = frame.error_percent();
    if (!std::isfinite(percent)) continue;
    ++count;
    sum += percent;
    if (worst != nullptr && percent <= most) continue;
    worst = &frame;
    most = percent;
  }
  if (worst == nullptr) return "no frame has a known volume";
  std::string text = fmt::format("{:.2f} % of the solid on average, {:.2f} % at most ({})",
                                 sum / static_cast<double>(count), most, medial_vk::quoted(worst->name));
  const double rest = record.frames.front().error_percent();
  if (std::isfinite(rest)) text = fmt::format("{:.2f} % at rest, {}", rest, text);
  const std::size_t without = record.frames.size() - count;
  if (without == 0) return text;
  return fmt::format("{}; {}", text, counted(without, "frame has no known volume", "frames have no known volume"));
}

/// What a reader of the volumes must know of frames, if anything.
std::string frame_notes(const MotionRecord& record) {
  bool has_unknown = false;
  std::uint64_t mirrored = 0;
  for (const FollowedFrame& frame : record.frames) {
    const bool is_known = std::isfinite(frame.solid_volume());
    has_unknown |= !is_known;
    mirrored += is_known && frame.is_mirrored ? 1 : 0;
  }
  std::string text;
  if (has_unknown) {
    text += labelled("note",
                     "no volume is known of a frame that is flat, or whose faces cross, lie inside or are turned over");
  }
  if (mirrored > 0) {
    text += labelled("note", fmt::format("{}: {} inside is that of the mesh turned inside out",
                                         counted(mirrored, "frame is mirrored", "frames are mirrored"),
                                         mirrored == 1 ? "its" : "their"));
  }
  return text;
}

std::string states_text(const MotionRecord& record) {
  std::string text;
  const std::vector<std::size_t> counts = state_counts(record, record.frames.back());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(counts[i]), state_names(record)[i]);
  }
  return text + " in the last frame";
}

std::string proved_text(const MotionRecord& record, bool closed) {
  if (!closed) return "the balls cover the surface, which is not closed, in every frame";
  const auto solids = std::ranges::count_if(
      record.frames, [](const FollowedFrame& frame) { return frame.cover->proved == CoverState::kSolid; });
  if (solids == std::ssize(record.frames)) return "the balls cover the solid in every frame";
  return fmt::format("the balls cover the surface in every frame, and the solid in {} of {}", grouped(solids),
                     grouped(record.frames.size()));
}

/// In the worst frame; empty where it was not measured.
std::string reach_text(const MotionRecord& record) {
  double worst = -1;
  for (const FollowedFrame& frame : record.frames) worst = std::max(worst, frame.cover->reach_out_bound.value_or(-1));
  return worst < 0 ? std::string() : fmt::format("by at most {:.3g} in any frame", worst);
}

std::string cover_lines(const MotionRecord& record, bool closed) {
  std::string text = labelled("proved", proved_text(record, closed));
  if (record.has_volume) text += labelled("added", error_text(record));
  if (const std::string reach = reach_text(record); !reach.empty()) text += labelled("reach out", reach);
  return text;
}

/// The balls' volume outside, over that of the solid, in the worst frame: an upper bound, and the estimate.
std::string outside_text(const MotionRecord& record) {
  double worst = 0, most = -1, error = 0;
  for (const FollowedFrame& frame : record.frames) {
    if (!(frame.measures.solid_volume > 0)) continue;
    const double percent = 100 / frame.measures.solid_volume;
    worst = std::max(worst, percent * frame.measures.outside_bound);
    if (!frame.outside || percent * frame.outside->volume <= most) continue;
    most = percent * frame.outside->volume;
    error = percent * frame.outside->standard_error;
  }
  std::string text = fmt::format("at most {:.2f} % of the solid, in any frame", worst);
  if (most == 0) text += fmt::format("; none of the samples: below {:.1g} % (95 %)", error);
  if (most > 0) text += fmt::format("; in the worst one {:.2g} % by samples (standard error {:.1g} %)", most, error);
  return text;
}

/// Milliseconds below a second.
std::string each_text(double seconds) {
  return seconds < 0.9995 ? fmt::format("{:.3g} ms", 1e3 * seconds) : duration(seconds);
}

/// How many balls joints alone keep inside, and how far all of them would reach out with their radii at rest: those
/// that no file shows as nodes, too.
std::string rig_text(const BallRig& rig) {
  const auto inside = std::ranges::count_if(rig.balls, [](const RigBall& ball) { return ball.radius > 0; });
  double share = 0;
  for (const RigBall& ball : rig.balls) share += ball.rest_radius > 0 ? ball.radius / ball.rest_radius : 0;
  return fmt::format(
      "{} of {} balls inside in every frame, with {:.0f} % of their radii on average; with their radii at rest "
      "all {} would reach out by {:.3g} at most",
      grouped(inside), grouped(rig.balls.size()), 100 * share / static_cast<double>(rig.balls.size()),
      grouped(rig.balls.size()), rig.greatest_reach_out());
}

}  // namespace

std::string follow_opening(const FollowOptions& options, const MeshReport& report, std::uint64_t frames,
                           std::uint64_t separable) {
  std::string text = fmt::format("{}: {} triangles, {}; {} {}\n", options.rest == "-" ? "standard input" : options.rest,
                                 grouped(report.triangles), report.closed ? "closed" : "not closed", grouped(frames),
                                 frames == 1 ? "frame" : "frames");
  if (report.closed && !encloses_volume(report)) {
    text +=
        labelled("note", report.intersections_known
                             ? "faces cross or lie inside the solid: parts that overlap would count twice, so no "
                               "volume is known"
                             : "too many faces lie close together to know whether some cross, so no volume is known");
  }
  if (separable > 0) {
    text +=
        labelled("note", fmt::format("{} vertices stand for several of the file that may part; each moves as the first",
                                     grouped(separable)));
  }
  if (!options.verbose) return text;
  for (const std::string& assumption : report.assumptions) text += labelled("note", assumption);
  return text;
}

std::string follow_summary(const FollowOptions& options, const MotionRecord& record, bool closed, const BallRig& rig,
                           const PartedVertices& parted, double update_seconds, const std::vector<StageTime>& times,
                           std::span<const OutputFile> files) {
  std::string text = labelled("balls", grouped(record.frames.front().balls.size()));
  text += labelled("rule", rule_text(options));
  if (record.covers) {
    text += cover_lines(record, closed);
  } else if (record.has_volume) {
    text += labelled("uncovered", error_text(record));
  }
  if (options.follower.rule == FollowRule::kPublished && record.has_volume) {
    text += labelled("outside", outside_text(record));
  }
  if (record.has_volume) text += frame_notes(record);
  if (record.renews) text += labelled("anew", renewed_text(options, record));
  text += labelled("states", states_text(record));
  if (!rig.balls.empty()) text += labelled("rig", rig_text(rig));
  const auto lost = std::ranges::count(record.frames.front().states, FollowState::kLost);
  if (lost > 0) {
    text += labelled("note", fmt::format("{} balls are not known to be inside the open mesh at rest", grouped(lost)));
  }
  if (parted.count > 0) {
    text += labelled("note", fmt::format("{} vertices of the file are at the place of another one at rest, and up to "
                                         "{:.3g} apart in a frame; each moves as the first at its place",
                                         grouped(parted.count), parted.distance));
  }
  const std::size_t moved = record.frames.size() - 1;
  if (moved > 0) {
    text += labelled("each", each_text(update_seconds / static_cast<double>(moved)) + " a frame");
  }
  text += labelled("time", times_text(times, options.verbose));
  return text + written_text(files, false);
}

}  // namespace medial_vk::cli
