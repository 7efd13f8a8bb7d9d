#include "output/charts_and_tables/volume_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "output/charts_and_tables/svg_drawing.h"

namespace medial_vk {
namespace {

struct CurvePoint {
  std::size_t sheets;
  double volume;
};

/// From all sheets down to the kept ones.
std::vector<CurvePoint> points_of(const SheetRemoval& removal) {
  const std::size_t all = removal.sheets.size() + removal.kept.size();
  std::vector<CurvePoint> points = {{all, 1}};
  for (std::size_t n = 0; n < removal.sheets.size(); ++n) points.push_back({all - n - 1, removal.volume_left[n]});
  return points;
}

void append_rows(std::string& text, const char* order, const SheetRemoval& removal) {
  const std::vector<CurvePoint> points = points_of(removal);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const std::string next = n < removal.sheets.size() ? std::to_string(removal.sheets[n]) : "";
    text += fmt::format("{},{},{},{}\n", order, points[n].sheets, points[n].volume, next);
  }
}

// Dimensions of the drawing, in its units.
constexpr double kCurveWidth = 640, kHeight = 400, kCurveLeft = 64, kCurveRight = 16, kCurveTop = 40, kCurveBottom = 52;

class Drawing {
 public:
  explicit Drawing(std::size_t sheets)
      : sheets_(static_cast<double>(std::max<std::size_t>(sheets, 1))), out_(kCurveWidth, kHeight) {}

  void axes() {
    for (int fifths = 0; fifths <= 5; ++fifths) {
      const double share = 0.2 * fifths;
      line(0, share, sheets_, share, "grid");
      out_.text(x(0) - 8, y(share) + 4, "end", fmt::format("{:.0f} %", 100 * share));
    }
    const double step = std::max(1.0, tick_step(sheets_));
    for (std::size_t tick = 0; step * static_cast<double>(tick) <= sheets_; ++tick) {
      const double sheets = step * static_cast<double>(tick);
      line(sheets, 0, sheets, 0.015, "axis");
      out_.text(x(sheets), y(0) + 18, "middle", fmt::format("{:.0f}", sheets));
    }
    line(0, 0, sheets_, 0, "axis");
    line(0, 0, 0, 1, "axis");
    out_.text((x(0) + x(sheets_)) / 2, kHeight - 12, "middle", "number of sheets");
    out_.text(x(0), kCurveTop - 16, "start", "share of the volume of the union of balls");
  }

  void curve(const SheetRemoval& removal, const char* kind, const char* name, double name_height) {
    std::vector<std::pair<double, double>> points;
    for (const CurvePoint& point : points_of(removal)) {
      points.emplace_back(x(static_cast<double>(point.sheets)), y(point.volume));
    }
    out_.curve(points, kind);
    const double legend = kCurveWidth - kCurveRight - 210;
    out_.key(legend, y(name_height) - 4, kind);
    out_.text(legend + 32, y(name_height), "start", name);
  }

  std::string finish() const {
    return out_.finish(
        "polyline,path{fill:none;stroke-width:2}"
        ".significance{stroke:#0072b2}.topology{stroke:#d55e00;stroke-dasharray:6 3}");
  }

 private:
  double x(double sheets) const { return kCurveLeft + (kCurveWidth - kCurveLeft - kCurveRight) * sheets / sheets_; }
  static double y(double share) { return kHeight - kCurveBottom - (kHeight - kCurveTop - kCurveBottom) * share; }

  void line(double sheets_a, double share_a, double sheets_b, double share_b, const char* kind) {
    out_.line(x(sheets_a), y(share_a), x(sheets_b), y(share_b), kind);
  }

  double sheets_;
  SvgDrawing out_;
};

}  // namespace

std::string encode_curve_csv(const VolumeCurves& curves) {
  std::string text = "order,sheets,volume,removed\n";
  append_rows(text, "significance", curves.by_significance);
  append_rows(text, "topology", curves.keeping_topology);
  return text;
}

std::string encode_curve_svg(const VolumeCurves& curves) {
  const SheetRemoval& all = curves.by_significance;
  Drawing drawing(all.sheets.size() + all.kept.size());
  drawing.axes();
  drawing.curve(curves.by_significance, "significance", "least significant first", 0.2);
  drawing.curve(curves.keeping_topology, "topology", "topology kept", 0.12);
  return drawing.finish();
}

}  // namespace medial_vk
