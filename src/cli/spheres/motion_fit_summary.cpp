#include "cli/spheres/motion_fit_summary.h"

#include <fmt/format.h>

#include <cmath>

#include "base/quoted.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"

namespace medial_vk::cli {
namespace {

/// At rest, on average and at most; frames whose volume is not known are left out, and counted.
std::string shares_text(std::span<const MeasuredFrame> frames) {
  const MeasuredFrame* worst = &frames.front();
  std::uint64_t without = 0;
  for (const MeasuredFrame& frame : frames) {
    if (std::isnan(frame.measures.solid_volume)) {
      ++without;
    } else if (frame.uncovered_share() > worst->uncovered_share()) {
      worst = &frame;
    }
  }
  std::string text = fmt::format("{:.2f} % of the solid on average, {:.2f} % at most ({}), {:.2f} % at rest",
                                 100 * mean_uncovered(frames), 100 * worst->uncovered_share(),
                                 medial_vk::quoted(worst->name), 100 * frames.front().uncovered_share());
  if (without > 0) text += "; " + counted(without, "frame has no known volume", "frames have no known volume");
  return text;
}

}  // namespace

double mean_uncovered(std::span<const MeasuredFrame> frames) {
  double sum = 0;
  std::size_t count = 0;
  for (const MeasuredFrame& frame : frames) {
    if (std::isnan(frame.measures.solid_volume)) continue;
    sum += frame.uncovered_share();
    ++count;
  }
  return sum / static_cast<double>(count);
}

std::string motion_fit_opening(const SpheresOptions& options, const MeshReport& report, std::uint64_t frames,
                               const std::optional<DeviceDescription>& device) {
  std::string text =
      fmt::format("{}: {}; {}\n", options.input == "-" ? "standard input" : options.input,
                  counted(report.triangles, "triangle", "triangles"), counted(frames, "frame", "frames"));
  for (const std::string& assumption : report.assumptions) text += labelled("note", assumption);
  if (!device) return text + labelled("device", "CPU reference, double precision");
  return text + labelled("device", fmt::format("{} ({}), {}", device->name, device->type, device->driver));
}

std::string motion_fit_summary(const SpheresOptions& options, std::size_t count, std::span<const MeasuredFrame> frames,
                               std::span<const MeasuredFrame> of_rest, bool is_of_rest,
                               const std::vector<StageTime>& times, std::span<const OutputFile> files) {
  std::string text = labelled("spheres", grouped(count));
  text += labelled("uncovered", shares_text(frames));
  if (is_of_rest) {
    text += labelled("note", "these are the spheres of the fit at rest: no better ones were found for the frames");
  } else {
    text += labelled("at rest", "the fit at rest would leave " + shares_text(of_rest));
  }
  text += labelled("proved", "no sphere reaches out at rest, nor, as it follows, in any frame");
  text += labelled("time", times_text(times, options.verbose));
  return text + written_text(files);
}

}  // namespace medial_vk::cli
