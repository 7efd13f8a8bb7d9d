#include "shape_files/svg/svg_path.h"

#include <fmt/format.h>

#include "base/quoted.h"
#include "shape_files/svg/svg_scanner.h"

namespace medial_vk {
namespace {

constexpr std::string_view kCommands = "MLHVCSQTAZ";

char upper_case(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

class PathReader {
 public:
  PathReader(std::string_view data, const SvgMatrix& matrix) : scanner_(data), matrix_(matrix) {}

  std::vector<Outline> read() {
    while (!scanner_.at_end()) {
      begin_command();
      run_command();
    }
    return std::move(outlines_);
  }

 private:
  void begin_command() {
    const char c = scanner_.next();
    if (kCommands.find(upper_case(c)) != std::string_view::npos) {
      if (outlines_.empty() && upper_case(c) != 'M') throw SvgFault{"the path does not begin with the command M"};
      relative_ = c != upper_case(c);
      before_ = command_;
      command_ = upper_case(c);
      scanner_.step();
      return;
    }
    if (command_ == '\0' || command_ == 'Z' || !scanner_.starts_number()) {
      throw SvgFault{fmt::format("{} is no command of a path", quoted(scanner_.rest()))};
    }
    before_ = command_;
    if (command_ == 'M') command_ = 'L';  // further points of a command M are joined by lines
  }

  void run_command() {
    switch (command_) {
      case 'M':
        return move_to(point());
      case 'Z':
        return close();
      case 'L':
        return line_to(point());
      case 'H':
        return line_to({scanner_.number() + (relative_ ? at_[0] : 0), at_[1]});
      case 'V':
        return line_to({at_[0], scanner_.number() + (relative_ ? at_[1] : 0)});
      case 'A':
        return arc();
      default:
        return bezier();
    }
  }

  PlanePoint point() {
    PlanePoint p;
    for (std::size_t k = 0; k < 2; ++k) p[k] = scanner_.number() + (relative_ ? at_[k] : 0);
    return p;
  }

  void move_to(const PlanePoint& p) {
    at_ = start_ = p;
    outlines_.emplace_back().start = matrix_ * p;
    open_ = true;
  }

  /// The outline that goes on; after Z, a new one from where the last began.
  Outline& outline() {
    if (!open_) move_to(start_);
    return outlines_.back();
  }

  void line_to(const PlanePoint& p) {
    PlaneCurve curve;
    curve.end = matrix_ * p;
    outline().curves.push_back(curve);
    at_ = p;
  }

  void close() {
    if (open_) outlines_.back().closed = true;
    open_ = false;
    at_ = start_;
  }

  /// The mirror image of the last control point, if the command before was one of these two; otherwise the point here.
  PlanePoint reflected(char command, char smooth) const {
    if (before_ != command && before_ != smooth) return at_;
    return {2 * at_[0] - control_[0], 2 * at_[1] - control_[1]};
  }

  void bezier() {
    PlaneCurve curve;
    const bool cubic = command_ == 'C' || command_ == 'S';
    curve.kind = cubic ? CurveKind::kCubic : CurveKind::kQuadratic;
    PlanePoint first;
    if (command_ == 'C' || command_ == 'Q') {
      first = point();
    } else {
      first = cubic ? reflected('C', 'S') : reflected('Q', 'T');
    }
    control_ = cubic ? point() : first;
    const PlanePoint end = point();
    curve.first = matrix_ * first;
    curve.second = matrix_ * control_;
    curve.end = matrix_ * end;
    outline().curves.push_back(curve);
    at_ = end;
  }

  void arc() {
    const double rx = scanner_.number(), ry = scanner_.number(), degrees = scanner_.number();
    const bool large = scanner_.flag(), positive = scanner_.flag();
    const PlanePoint end = point();
    add_arc(outline(), matrix_, at_, end, rx, ry, degrees, large, positive);
    at_ = end;
  }

  SvgScanner scanner_;
  SvgMatrix matrix_;
  std::vector<Outline> outlines_;
  PlanePoint at_ = {}, start_ = {}, control_ = {};  // before the matrix
  char command_ = '\0', before_ = '\0';
  bool relative_ = false, open_ = false;
};

}  // namespace

std::vector<Outline> parse_svg_path(std::string_view data, const SvgMatrix& matrix) {
  if (without_svg_blanks(data) == "none") return {};
  return PathReader(data, matrix).read();
}

}  // namespace medial_vk
