#include "output/distance_page/distance_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "output/charts_and_tables/svg_drawing.h"
#include "output/page/base64.h"

namespace medial_vk {
namespace {

constexpr double kWidth = 720, kHeight = 280, kLeft = 64, kRight = 20, kTop = 24, kBottom = 48;
constexpr std::size_t kBins = 30;

bool is_counted(const PoseInterval& interval) {
  return interval.collision != Collision::kHit && std::isfinite(interval.upper);
}

struct Bin {
  std::size_t free = 0, undecided = 0;
};

std::vector<Bin> bins_of(std::span<const PoseInterval> intervals, double greatest) {
  std::vector<Bin> bins(kBins);
  for (const PoseInterval& interval : intervals) {
    if (!is_counted(interval)) continue;
    const double position = greatest > 0 ? interval.upper / greatest * kBins : 0;
    Bin& bin = bins[std::min(static_cast<std::size_t>(position), kBins - 1)];
    ++(interval.collision == Collision::kFree ? bin.free : bin.undecided);
  }
  return bins;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return out;
}

struct State {
  Collision collision;
  const char* name;
  const char* kind;
};
constexpr std::array<State, 3> kStates = {{{Collision::kFree, "free", "free"},
                                           {Collision::kHit, "hit", "hit"},
                                           {Collision::kUndecided, "undecided", "undecided"}}};

/// A bar as wide as the page, divided by the states, and a table of them.
std::string states_html(std::span<const PoseInterval> intervals) {
  std::string bar, rows;
  for (const State& state : kStates) {
    const auto count = std::ranges::count(intervals, state.collision, &PoseInterval::collision);
    const double share = 100.0 * static_cast<double>(count) / static_cast<double>(intervals.size());
    if (count > 0) bar += fmt::format("<span class=\"{}\" style=\"flex:{}\"></span>", state.kind, count);
    rows += fmt::format("<tr><td><i class=\"{}\"></i>{}</td><td>{}</td><td>{:.2f} %</td></tr>\n", state.kind,
                        state.name, count, share);
  }
  return fmt::format("<div class=\"bar\">{}</div>\n<table>\n{}</table>\n", bar, rows);
}

std::string shown_text(const DistancePage& page) {
  const PoseInterval& shown = page.intervals[page.shown];
  std::string pose = "The " + page.pose;
  if (page.intervals.size() > 1) {
    const std::string word = static_cast<char>(std::toupper(page.pose.front())) + page.pose.substr(1);
    pose = fmt::format("{} {} of {}{}", word, page.shown + 1, page.intervals.size(),
                       page.is_chosen ? "" : ", that of the least distance");
  }
  if (shown.collision == Collision::kHit) return pose + ": the solids have a common point.";
  if (shown.lower > 0 && shown.lower <= std::numeric_limits<double>::min()) {  // a limit of 0 asks for this alone
    return pose + ": the solids have no common point.";
  }
  if (!std::isfinite(shown.upper)) {
    return fmt::format("{}: the distance is at least {:.9g}, in {}.", pose, shown.lower, page.unit);
  }
  return fmt::format("{}: the distance is between {:.9g} and {:.9g}, in {}.", pose, shown.lower, shown.upper,
                     page.unit);
}

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1000px;margin:32px auto;padding:0 20px}"
    "h1{font-size:24px;margin:0 0 4px}h2{font-size:18px;margin:32px 0 8px}p{margin:4px 0 12px;color:#444}"
    "img{width:100%;border:1px solid #e2e5ea;border-radius:8px}svg{max-width:100%;height:auto}"
    ".bar{display:flex;height:22px;border-radius:6px;overflow:hidden;margin:8px 0 12px}"
    "table{border-collapse:collapse}td{padding:2px 24px 2px 0}td+td{text-align:right;font-variant-numeric:tabular-nums}"
    "i{display:inline-block;width:12px;height:12px;border-radius:3px;margin-right:8px}"
    ".free{background:#0072b2}.hit{background:#d55e00}.undecided{background:#b8bec7}";

}  // namespace

std::string encode_distances_svg(const DistancePage& page) {
  const std::span<const PoseInterval> intervals = page.intervals;
  double greatest = 0;
  for (const PoseInterval& interval : intervals) {
    if (is_counted(interval)) greatest = std::max(greatest, interval.upper);
  }
  if (!(greatest > 0)) greatest = 1;  // an empty diagram, or one bar at 0
  const std::vector<Bin> bins = bins_of(intervals, greatest);
  std::size_t most = 1;
  for (const Bin& bin : bins) most = std::max(most, bin.free + bin.undecided);
  SvgDrawing out(kWidth, kHeight);
  const double base = kHeight - kBottom, tall = base - kTop, wide = kWidth - kLeft - kRight;
  const auto height = [&](std::size_t count) { return tall * static_cast<double>(count) / static_cast<double>(most); };
  for (std::size_t i = 0; i < kBins; ++i) {
    const double left = kLeft + wide * static_cast<double>(i) / kBins, width = wide / kBins * 0.92;
    const double free = height(bins[i].free), undecided = height(bins[i].undecided);
    if (free > 0) out.bar(left, base - free, width, free, "of-free");
    if (undecided > 0) out.bar(left, base - free - undecided, width, undecided, "of-undecided");
  }
  const double step = tick_step(greatest);
  for (int k = 0; k * step <= greatest * (1 + 1e-9); ++k) {
    const double x = kLeft + wide * k * step / greatest;
    out.line(x, base, x, base + 4, "axis");
    out.text(x, base + 18, "middle", fmt::format("{:.3g}", k * step));
  }
  out.line(kLeft, base, kWidth - kRight, base, "axis");
  out.line(kLeft, base, kLeft, kTop, "axis");
  out.text(kLeft - 8, kTop + 4, "end", fmt::format("{}", most));
  out.text(kLeft - 8, base + 4, "end", "0");
  out.text(kLeft + wide / 2, base + 38, "middle",
           fmt::format("upper end of the distance, {}; number of {}s", page.unit, page.pose));
  return out.finish(".of-free{fill:#0072b2}.of-undecided{fill:#b8bec7}");
}

std::string encode_distance_page(const DistancePage& page) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'\">\n<title>{0}</title>\n<style>{1}</style>\n"
      "<h1>{0}</h1>\n<p>{2}</p>\n",
      escaped(page.title), kStyle, shown_text(page));
  html += fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,", page.picture);
  page::append_base64(html, {reinterpret_cast<const std::uint8_t*>(page.png.data()), page.png.size()});
  html += fmt::format("\">\n<h2>{} {}</h2>\n<p>Free: no common point, proved. Hit: a common point, proved. {}</p>\n",
                      page.intervals.size(), page.pose + (page.intervals.size() == 1 ? "" : "s"),
                      page.by_balls ? "Undecided: the balls prove neither; triangles are not searched."
                                    : "Undecided: the surfaces may touch, to within rounding or the tolerance.");
  html += states_html(page.intervals);
  html += "<h2>Distances</h2>\n" + encode_distances_svg(page) + "</html>\n";
  return html;
}

}  // namespace medial_vk
