#include "output/charts_and_tables/svg_drawing.h"

#include <fmt/format.h>

#include <cmath>

namespace medial_vk {

double tick_step(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 8)));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (range / (times * power) <= 8) return times * power;
  }
  return 10 * power;
}

void SvgDrawing::line(double x1, double y1, double x2, double y2, const char* kind) {
  out_ += fmt::format("<line class=\"{}\" x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"/>\n", kind, x1, y1,
                      x2, y2);
}

void SvgDrawing::text(double x, double y, const char* anchor, const std::string& words) {
  out_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
}

void SvgDrawing::curve(const std::vector<std::pair<double, double>>& points, const char* kind) {
  out_ += fmt::format("<polyline class=\"{}\" points=\"", kind);
  for (const auto& [x, y] : points) out_ += fmt::format("{:.2f},{:.2f} ", x, y);
  out_.back() = '"';
  out_ += "/>\n";
}

void SvgDrawing::bar(double x, double y, double width, double height, const char* kind) {
  out_ += fmt::format("<rect class=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>\n", kind, x, y,
                      width, height);
}

void SvgDrawing::key(double x, double y, const char* kind) {
  out_ += fmt::format("<path class=\"{}\" d=\"M{} {}h24\"/>\n", kind, x, y);
}

std::string SvgDrawing::finish(const std::string& style) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n"
      "<style>svg{{font:13px sans-serif;background:#fff;fill:#222}}"
      ".grid{{stroke:#ddd}}.axis{{stroke:#222}}{2}</style>\n{3}</svg>\n",
      width_, height_, style, out_);
}

}  // namespace medial_vk
