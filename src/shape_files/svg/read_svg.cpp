#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include "shape_files/svg/read_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quoted.h"
#include "input/text_scanner.h"
#include "shape_files/svg/svg_drawing.h"
#include "xml_files/xml_document.h"

namespace medial_vk {
namespace {

/// Where the first markup is that is neither a comment nor an instruction.
std::size_t end_of_prolog(std::string_view text) {
  for (std::size_t at = 0;;) {
    at = text.find('<', at);
    if (at == std::string_view::npos) return text.size();
    const std::string_view rest = text.substr(at);
    const std::string_view end = rest.starts_with("<!--") ? "-->" : rest.starts_with("<?") ? "?>" : "";
    if (end.empty()) return at;
    at = text.find(end, at + 2);
    if (at == std::string_view::npos) return text.size();
  }
}

/// Declarations within <!DOCTYPE ... [...]> are blanked, since the parser knows none; lines stay where they are.
/// Entities that they declare are not replaced, so that no text of a file grows.
std::string without_internal_subset(std::string_view bytes) {
  std::string text(bytes);
  const std::size_t type = end_of_prolog(text);
  if (!std::string_view(text).substr(type).starts_with("<!DOCTYPE")) return text;
  const std::size_t open = text.find_first_of("[>", type);
  if (open == std::string::npos || text[open] == '>') return text;
  std::size_t close = open;
  do {
    close = text.find(']', close + 1);
    if (close == std::string::npos) return text;
  } while (text.find_first_not_of(" \t\r\n", close + 1) != text.find('>', close + 1));
  for (std::size_t i = open; i <= close; ++i) {
    if (text[i] != '\n' && text[i] != '\r') text[i] = ' ';
  }
  return text;
}

/// Figures that are filled; all of them where none is, since outlines for machines have no fill.
void drop_unfilled(SvgDrawing& drawing, std::vector<std::string>& sentences) {
  const auto is_unfilled = [](const SvgFigure& figure) { return !figure.filled; };
  const auto unfilled = static_cast<std::uint64_t>(std::ranges::count_if(drawing.figures, is_unfilled));
  if (unfilled == 0) return;
  if (unfilled == drawing.figures.size()) {
    sentences.emplace_back("No element has a fill; all count as if they had.");
    return;
  }
  std::erase_if(drawing.figures, is_unfilled);
  add_sentence(sentences, unfilled, "element without a fill is left out.", "elements without a fill are left out.");
}

void state_assumptions(const SvgDrawing& drawing, std::vector<std::string>& s) {
  add_sentence(s, drawing.hidden, "element is not displayed and is left out.",
               "elements are not displayed and are left out.");
  add_sentence(s, drawing.lines, "<line> has no area and is left out.",
               "elements <line> have no area and are left out.");
  add_sentence(s, drawing.texts, "<text> is left out; convert it to a path.",
               "elements <text> are left out; convert them to paths.");
  add_sentence(s, drawing.images, "<image> is left out.", "elements <image> are left out.");
  add_sentence(s, drawing.foreign, "<foreignObject> is left out.", "elements <foreignObject> are left out.");
  add_sentence(s, drawing.clipped,
               "element has a clip path, a mask or an origin of its transform, which is not applied.",
               "elements have a clip path, a mask or an origin of their transform, which is not applied.");
  add_sentence(s, drawing.broken_links, "<use> refers to no element of the file and is left out.",
               "elements <use> refer to no element of the file and are left out.");
  if (drawing.has_style_sheet) s.emplace_back("The style sheet of the file is not applied.");
  if (std::fabs(drawing.stretched - 1) > 1e-6) {
    s.push_back(
        fmt::format("The file is shown {:.4g} times as wide for its height as its coordinates are, which count.",
                    drawing.stretched));
  }
}

std::string name_of(const tinyxml2::XMLElement& element) {
  // Faults are those of elements with known names, so it is short.
  return fmt::format("<{}>", local_name(element));
}

class FigureFlattener {
 public:
  FigureFlattener(const SvgDrawing& drawing, const std::string& name) : drawing_(drawing), name_(name) {}

  Status flatten_all(std::optional<double> flatness, double share, SvgAreas& areas) {
    CurveBox box;
    for (const SvgFigure& figure : drawing_.figures) {
      CurveBox own;
      for (const Outline& outline : figure.outlines) own.add(outline);
      const auto is_fine = [](double x) { return std::fabs(x) <= kMostPlaneCoordinate; };
      if (!std::ranges::all_of(own.lower, is_fine) || !std::ranges::all_of(own.upper, is_fine) ||
          is_unbounded(figure)) {
        return element_error(name_, *figure.element,
                             fmt::format("{}: a coordinate is beyond 1e150", name_of(*figure.element)));
      }
      box.add(own.lower);
      box.add(own.upper);
    }
    flatness_ = flatness.value_or(share * box.longest_side());
    if (!(flatness_ > 0)) flatness_ = 1;  // of a single point
    if (Status status = check_points(areas); !status) return status;
    if (areas.curves > 0) areas.flatness = flatness_;
    areas.areas.reserve(drawing_.figures.size());
    for (const SvgFigure& figure : drawing_.figures) {
      ShapeArea& area = areas.areas.emplace_back();
      area.rule = figure.rule;
      area.rings.reserve(figure.outlines.size());
      for (const Outline& outline : figure.outlines) add_ring(outline, area, areas);
    }
    return {};
  }

 private:
  /// Boxes leave out what is not a number, and the centres of arcs.
  static bool is_unbounded(const SvgFigure& figure) {
    const auto is_bad = [](const PlanePoint& p) { return !std::isfinite(p[0]) || !std::isfinite(p[1]); };
    return std::ranges::any_of(figure.outlines, [&](const Outline& outline) {
      return is_bad(outline.start) || std::ranges::any_of(outline.curves, [&](const PlaneCurve& curve) {
               return is_bad(curve.end) || is_bad(curve.first) || is_bad(curve.second) || is_bad(curve.centre);
             });
    });
  }

  Status check_points(SvgAreas& areas) const {
    double points = 0;
    for (const SvgFigure& figure : drawing_.figures) {
      for (const Outline& outline : figure.outlines) {
        PlanePoint at = outline.start;
        points += 1;
        for (const PlaneCurve& curve : outline.curves) {
          points += parts_of(curve, at, flatness_);
          at = curve.end;
          if (curve.kind != CurveKind::kLine) ++areas.curves;
        }
      }
      if (points > static_cast<double>(kMostShapePoints)) {
        return element_error(name_, *figure.element,
                             fmt::format("{}: flattened to {:g}, the file has more than {} points",
                                         name_of(*figure.element), flatness_, kMostShapePoints));
      }
    }
    return {};
  }

  void add_ring(const Outline& outline, ShapeArea& area, SvgAreas& areas) const {
    if (outline.curves.empty()) return;
    const bool open = !outline.closed && outline.curves.back().end != outline.start;
    area.rings.push_back(flatten(outline, flatness_));
    if (open && area.rings.back().size() > 2) ++areas.open_outlines;
  }

  const SvgDrawing& drawing_;
  const std::string& name_;
  double flatness_ = 1;
};

}  // namespace

Result<SvgAreas> read_svg(std::string_view bytes, const std::string& name, std::optional<double> flatness,
                          double share) {
  tinyxml2::XMLDocument document;
  if (Status status = parse_xml(without_internal_subset(bytes), name, "SVG", "svg", document); !status) {
    return status.error();
  }
  SvgDrawing drawing;
  try {
    drawing = collect_figures(*document.RootElement(), bytes.size());
  } catch (const SvgElementFault& fault) {
    return element_error(name, *fault.element, fmt::format("{}: {}", name_of(*fault.element), fault.what));
  }
  SvgAreas areas;
  areas.view_box = drawing.view_box;
  drop_unfilled(drawing, areas.assumptions);
  state_assumptions(drawing, areas.assumptions);
  if (drawing.figures.empty()) return file_error(name, "no element of this SVG has an area");
  if (Status status = FigureFlattener(drawing, name).flatten_all(flatness, share, areas); !status) {
    return status.error();
  }
  return areas;
}

}  // namespace medial_vk
#else
#include "common/absent_parts.h"
#include "input/text_scanner.h"
#include "shape_files/svg/read_svg.h"

namespace medial_vk {

Result<SvgAreas> read_svg(std::string_view, const std::string& name, std::optional<double>, double) {
  return file_error(name, not_read("SVG", "tinyxml2"));
}

}  // namespace medial_vk
#endif
