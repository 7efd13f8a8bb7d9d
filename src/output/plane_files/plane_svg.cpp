#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <tuple>

#include "output/colours/colour_map.h"
#include "output/plane_files/plane_files.h"

namespace medial_vk {
namespace {

constexpr int kColours = 32;  // a polyline for each run of one colour

class PlaneSvg {
 public:
  explicit PlaneSvg(const PlaneRecord& record) : record_(record), up_(record.y_is_down ? 1 : -1) {
    const auto [lower, upper] = bounds_of(record);
    const double width = upper[0] - lower[0], height = upper[1] - lower[1];
    const double margin = 0.04 * std::max(width, height);
    box_ = {lower[0] - margin, (record.y_is_down ? lower[1] : -upper[1]) - margin, width + 2 * margin,
            height + 2 * margin};
    if (record.view_box) box_ = *record.view_box;
    std::tie(least_, greatest_) = colour_range(record);
  }

  std::string encode() {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {} {}\">\n", box_[0], box_[1], box_[2], box_[3]);
    add("<style>.shape{{fill:#dfe9f1;stroke:#7d93a6;stroke-width:1}}.axis{{fill:none;stroke-width:2.5;"
        "stroke-linecap:round;stroke-linejoin:round}}.node{{fill:none;stroke:#222;stroke-width:5;"
        "stroke-linecap:round}}path,polyline{{vector-effect:non-scaling-stroke}}</style>\n");
    add_shape();
    for (std::size_t b = 0; b < record_.lines.size(); ++b) add_branch(b);
    add_junctions();
    add_path();
    out_ += "</svg>\n";
    return std::move(out_);
  }

 private:
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), text, std::forward<Arguments>(arguments)...);
  }

  void add_shape() {
    out_ += "<path class=\"shape\" fill-rule=\"evenodd\" d=\"";
    for (const auto& ring : rings_of(record_.shape)) {
      char command = 'M';
      for (const std::uint32_t i : ring) {
        add("{}{} {}", command, record_.shape.points[i][0], up_ * record_.shape.points[i][1]);
        command = 'L';
      }
      out_ += 'Z';
    }
    out_ += "\"/>\n";
  }

  int colour_at(const AxisSample& a, const AxisSample& b) const {
    const double value = (coloured_value(record_, a) + coloured_value(record_, b)) / 2;
    const double share = greatest_ > least_ ? (value - least_) / (greatest_ - least_) : 0;
    return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * (kColours - 1)));
  }

  /// With further points where the colour changes between two points.
  std::vector<AxisSample> refined(const std::vector<AxisSample>& line) const {
    std::vector<AxisSample> fine = {line.front()};
    for (std::size_t i = 1; i < line.size(); ++i) {
      const AxisSample &a = line[i - 1], &b = line[i];
      const int parts = std::abs(colour_at(a, a) - colour_at(b, b)) + 1;
      for (int k = 1; k < parts; ++k) {
        const double t = static_cast<double>(k) / parts;
        fine.push_back({{a.point[0] + t * (b.point[0] - a.point[0]), a.point[1] + t * (b.point[1] - a.point[1])},
                        a.radius + t * (b.radius - a.radius),
                        a.object_angle + t * (b.object_angle - a.object_angle)});
      }
      fine.push_back(b);
    }
    return fine;
  }

  void add_branch(std::size_t b) {
    const std::vector<AxisSample> line = refined(record_.lines[b]);
    add("<g id=\"branch-{}\">\n", b);
    for (std::size_t i = 1; i < line.size();) {
      const int colour = colour_at(line[i - 1], line[i]);
      const Eigen::Vector3f rgb = picture::viridis(static_cast<float>(colour) / (kColours - 1));
      add("<polyline class=\"axis\" stroke=\"#{:02x}{:02x}{:02x}\" points=\"", picture::byte_of(rgb[0]),
          picture::byte_of(rgb[1]), picture::byte_of(rgb[2]));
      add("{},{}", line[i - 1].point[0], up_ * line[i - 1].point[1]);
      for (; i < line.size() && colour_at(line[i - 1], line[i]) == colour; ++i) {
        add(" {},{}", line[i].point[0], up_ * line[i].point[1]);
      }
      out_ += "\"/>\n";
    }
    out_ += "</g>\n";
  }

  /// Round ends of strokes of no length: dots of the same size at any scale.
  void add_junctions() {
    out_ += "<path class=\"node\" d=\"";
    for (const AxisNode& node : record_.axis.nodes) {
      if (node.degree != 2 && node.degree != 1) add("M{} {}h0", node.point[0], up_ * node.point[1]);
    }
    out_ += "\"/>\n";
  }

  void add_path() {
    if (!record_.path) return;
    out_ += "<polyline id=\"path\" class=\"axis\" stroke=\"#d91a1a\" points=\"";
    for (const PlanePoint& p : record_.path->line) add("{},{} ", p[0], up_ * p[1]);
    out_.back() = '"';
    out_ += "/>\n";
  }

  const PlaneRecord& record_;
  double up_;
  std::array<double, 4> box_ = {};
  double least_ = 0, greatest_ = 0;
  std::string out_;
};

}  // namespace

std::string encode_plane_svg(const PlaneRecord& record) { return PlaneSvg(record).encode(); }

}  // namespace medial_vk
