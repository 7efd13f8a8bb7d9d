// Lines, text and bars as SVG, the elements of the program's diagrams.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace medial_vk {

/// A step of 1, 2 or 5 times a power of ten that divides `range` into at most eight parts.
double tick_step(double range);

/// Coordinates are in the units of the drawing, y downwards; `kind` is a class of the style.
class SvgDrawing {
 public:
  SvgDrawing(double width, double height) : width_(width), height_(height) {}

  void line(double x1, double y1, double x2, double y2, const char* kind);
  void text(double x, double y, const char* anchor, const std::string& words);
  void curve(const std::vector<std::pair<double, double>>& points, const char* kind);
  void bar(double x, double y, double width, double height, const char* kind);
  /// A stroke in the style of a curve, placed before its name.
  void key(double x, double y, const char* kind);

  /// The whole file. `style` holds rules for the kinds used; text, "grid" and "axis" have predefined ones.
  std::string finish(const std::string& style) const;

 private:
  double width_, height_;
  std::string out_;
};

}  // namespace medial_vk
