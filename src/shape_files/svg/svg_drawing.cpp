#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include "shape_files/svg/svg_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quoted.h"
#include "shape_files/svg/read_svg.h"
#include "shape_files/svg/svg_scanner.h"
#include "shape_files/svg/svg_shapes.h"
#include "xml_files/xml_document.h"

namespace medial_vk {
namespace {

using tinyxml2::XMLElement;

/// What holds for the children of an element.
struct Place {
  SvgMatrix matrix;
  SvgStyle style;
  SvgViewport viewport;
};

constexpr std::array<const char*, 4> kEffects = {"clip-path", "mask", "transform-origin", "transform-box"};

std::string_view prefix_of(const XMLElement& element) {
  const std::string_view name = element.Name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? std::string_view() : name.substr(0, colon);
}

class SvgVisitor {
 public:
  SvgVisitor(const XMLElement& root, std::uint64_t bytes)
      : root_(root),
        prefix_(prefix_of(root)),
        most_elements_(std::max(bytes, std::min(16 * bytes, kMostSvgInstances))),
        most_bytes_(std::max(bytes, std::min<std::uint64_t>(1000 * bytes, kMostBytes))) {}

  SvgDrawing read() {
    index();
    Place place;
    guarded(root_, [&] { place = outermost(); });
    visit_children(root_, place);
    return std::move(drawing_);
  }

 private:
  /// Attributes are read again for every instance of their element: some seconds at most.
  static constexpr std::uint64_t kMostBytes = 1u << 26;

  template <class Work>
  void guarded(const XMLElement& element, const Work& work) {
    try {
      work();
    } catch (const SvgFault& fault) {
      throw SvgElementFault{&element, fault.what};
    }
  }

  /// All elements in the order of the file, without recursion.
  void index() {
    const XMLElement* e = &root_;
    while (e != nullptr) {
      if (const char* id = e->Attribute("id")) by_id_.emplace(id, e);
      if (local_name(*e) == "style" && e->GetText() != nullptr) drawing_.has_style_sheet = true;
      if (const XMLElement* child = e->FirstChildElement()) {
        e = child;
        continue;
      }
      while (e != &root_ && e->NextSiblingElement() == nullptr) e = e->Parent()->ToElement();
      e = e == &root_ ? nullptr : e->NextSiblingElement();
    }
  }

  /// User coordinates are those of its viewBox, without the transformation to the screen.
  Place outermost() {
    Place place;
    place.style = style_of(root_, {});
    place.matrix = transform_of(root_);
    const SvgViewport unknown;
    const auto size = [&](const char* attribute) -> std::optional<double> {
      try {
        return svg_length(root_, attribute, unknown, LengthOf::kWidth);
      } catch (const SvgFault&) {
        return {};  // in units of a font or of a window
      }
    };
    const std::optional<double> width = size("width"), height = size("height");
    if ((width && *width < 0) || (height && *height < 0)) throw SvgFault{"width or height is negative"};
    if (const std::optional<SvgViewBox> box = view_box_of(root_)) {
      place.viewport = {box->width, box->height};
      drawing_.view_box = {box->x, box->y, box->width, box->height};
      if (width && height && *width > 0 && *height > 0 && box->width > 0 && box->height > 0) {
        const SvgMatrix fit = fit_view_box(root_, *box, *width, *height);
        drawing_.stretched = fit.a / fit.d;
      }
    } else {
      place.viewport = {width, height};
      if (width && height) drawing_.view_box = {0, 0, *width, *height};
    }
    return place;
  }

  void visit_children(const XMLElement& parent, const Place& place) {
    for (const XMLElement* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      visit(*e, place);
    }
  }

  void visit(const XMLElement& element, const Place& outer) {
    bytes_ += bytes_of_attributes(element);
    if (++elements_ > most_elements_ || bytes_ > most_bytes_) {
      throw SvgElementFault{&root_, "the elements <use> of the file show too many elements"};
    }
    if (depth_ == kMostSvgDepth) throw SvgElementFault{&root_, "elements are nested too deeply"};
    ++depth_;
    visit_counted(element, outer);
    --depth_;
  }

  void visit_counted(const XMLElement& element, const Place& outer) {
    if (prefix_of(element) != prefix_) return;  // of another namespace, such as those of editors
    const std::string_view kind = local_name(element);
    const bool groups = kind == "g" || kind == "a" || kind == "switch";
    if (!groups && kind != "svg" && kind != "use" && !is_svg_shape(kind)) return count_other(element, kind);
    Place place;
    bool shown = false;
    guarded(element, [&] { shown = enter(element, outer, place); });
    if (!shown) return;
    if (is_svg_shape(kind)) {
      guarded(element, [&] { add_figure(element, kind, place); });
    } else if (kind == "use") {
      use(element, place);
    } else if (kind == "svg") {
      bool has_extent = false;
      guarded(element, [&] { has_extent = enter_viewport(element, element, place); });
      if (has_extent) visit_children(element, place);
    } else if (kind == "switch") {
      if (const XMLElement* first = element.FirstChildElement()) visit(*first, place);
    } else {
      visit_children(element, place);
    }
  }

  /// The place within an element; false if it is not displayed.
  bool enter(const XMLElement& element, const Place& outer, Place& place) {
    if (svg_property(element, "display") == "none") {
      ++drawing_.hidden;
      return false;
    }
    place = {outer.matrix * transform_of(element), style_of(element, outer.style), outer.viewport};
    const auto has_effect = [&](const char* name) {
      const std::string_view value = svg_property(element, name);
      return !value.empty() && value != "none";
    };
    if (std::ranges::any_of(kEffects, has_effect)) ++drawing_.clipped;
    return true;
  }

  void count_other(const XMLElement& element, std::string_view kind) {
    if (svg_property(element, "display") == "none") return;
    if (kind == "line") ++drawing_.lines;
    if (kind == "text") ++drawing_.texts;
    if (kind == "image") ++drawing_.images;
    if (kind == "foreignObject") ++drawing_.foreign;
  }

  void add_figure(const XMLElement& element, std::string_view kind, const Place& place) {
    if (!place.style.visible) {
      ++drawing_.hidden;
      return;
    }
    std::vector<Outline> outlines = outlines_of(element, kind, place.matrix, place.viewport);
    if (outlines.empty()) return;
    drawing_.figures.push_back({std::move(outlines), place.style.rule, place.style.filled, &element});
  }

  /// The coordinates within a nested <svg> or a <symbol>, whose size `sized` states; false if it has no extent.
  bool enter_viewport(const XMLElement& element, const XMLElement& sized, Place& place) {
    const SvgViewport outer = place.viewport;
    const bool nested = &element == &sized;
    const auto length = [&](const char* name, LengthOf of) { return svg_length(sized, name, outer, of); };
    std::optional<double> width = length("width", LengthOf::kWidth), height = length("height", LengthOf::kHeight);
    if (!nested && local_name(element) == "svg") {  // those of `use` replace its own
      if (!width) width = svg_length(element, "width", outer, LengthOf::kWidth);
      if (!height) height = svg_length(element, "height", outer, LengthOf::kHeight);
    }
    if (!width) width = outer.width;
    if (!height) height = outer.height;
    if ((width && *width < 0) || (height && *height < 0)) throw SvgFault{"width or height is negative"};
    if ((width && *width == 0) || (height && *height == 0)) return false;
    const XMLElement* shifted = nested ? &sized : local_name(element) == "svg" ? &element : nullptr;
    if (shifted != nullptr) {
      const double x = svg_length(*shifted, "x", outer, LengthOf::kWidth).value_or(0);
      const double y = svg_length(*shifted, "y", outer, LengthOf::kHeight).value_or(0);
      place.matrix = place.matrix * SvgMatrix{1, 0, 0, 1, x, y};
    }
    place.viewport = {width, height};
    const std::optional<SvgViewBox> box = view_box_of(element);
    if (!box) return true;
    if (box->width == 0 || box->height == 0) return false;
    // Without any size of its own or around it, the box is shown as large as it is.
    const SvgMatrix fit = fit_view_box(element, *box, width.value_or(box->width), height.value_or(box->height));
    place.matrix = place.matrix * fit;
    place.viewport = {box->width, box->height};
    return true;
  }

  void use(const XMLElement& element, Place& place) {
    const XMLElement* target = nullptr;
    guarded(element, [&] {
      target = target_of(element);
      const double x = svg_length(element, "x", place.viewport, LengthOf::kWidth).value_or(0);
      const double y = svg_length(element, "y", place.viewport, LengthOf::kHeight).value_or(0);
      place.matrix = place.matrix * SvgMatrix{1, 0, 0, 1, x, y};
      if (std::ranges::find(active_, &element) != active_.end()) throw SvgFault{"it refers to itself"};
      if (active_.size() == kMostSvgUses) {
        throw SvgFault{fmt::format("it is within more than {} other elements <use>", kMostSvgUses)};
      }
    });
    if (target == nullptr) {
      ++drawing_.broken_links;
      return;
    }
    active_.push_back(&element);
    const std::string_view kind = local_name(*target);
    if (kind == "symbol" || kind == "svg") {
      Place within;
      bool shown = false;
      guarded(*target, [&] { shown = enter(*target, place, within) && enter_viewport(*target, element, within); });
      if (shown) visit_children(*target, within);
    } else {
      visit(*target, place);
    }
    active_.pop_back();
  }

  /// The element of this file that `use` names; nothing for another file, or a name that no element has.
  const XMLElement* target_of(const XMLElement& element) const {
    std::string_view link = svg_attribute(element, "href");
    if (link.empty()) link = svg_attribute(element, "xlink:href");
    link = without_svg_blanks(link);
    if (!link.starts_with('#')) return nullptr;
    const auto known = by_id_.find(link.substr(1));
    return known == by_id_.end() ? nullptr : known->second;
  }

  const XMLElement& root_;
  std::string_view prefix_;
  std::uint64_t most_elements_, most_bytes_, elements_ = 0, bytes_ = 0;
  int depth_ = 0;
  std::map<std::string_view, const XMLElement*> by_id_;
  std::vector<const XMLElement*> active_;
  SvgDrawing drawing_;
};

}  // namespace

SvgDrawing collect_figures(const XMLElement& root, std::uint64_t bytes) { return SvgVisitor(root, bytes).read(); }

}  // namespace medial_vk
#endif
