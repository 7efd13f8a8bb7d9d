#include "output/plane_picture/plane_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"
#include "output/plane_picture/canvas.h"

namespace medial_vk {
namespace {

using Eigen::Vector3f;
using picture::Canvas;
using picture::Spot;

constexpr std::uint32_t kWidth = 1600, kLeastHeight = 600, kGreatestHeight = 1500, kBand = 170;
constexpr double kMargin = 0.04;
const Vector3f kGlass(0.87f, 0.92f, 0.955f), kRim(0.42f, 0.53f, 0.63f), kInk(0.16f, 0.19f, 0.24f);
const Vector3f kPathColour(0.85f, 0.1f, 0.1f);
constexpr std::size_t kMostDiscs = 60, kMostMarks = 400;

/// A colour a little darker than viridis where that is almost as light as the glass.
Vector3f branch_colour(double share) {
  const auto t = static_cast<float>(std::clamp(share, 0.0, 1.0));
  return picture::viridis(0.93f * t);
}

class PlanePainter {
 public:
  explicit PlanePainter(const PlaneRecord& record)
      : record_(record), size_(size_of(record)), canvas_(kWidth, size_.height) {
    std::tie(least_, greatest_) = colour_range(record);
  }

  Picture draw() {
    draw_glass();
    draw_discs();
    draw_branches();
    draw_single_points();
    draw_marks();
    draw_path();
    Picture out = canvas_.picture();
    write_numbers(out);
    return out;
  }

 private:
  /// How the shape lies in the picture, in samples.
  struct Size {
    std::uint32_t height = 0;
    double scale = 1;
    Spot middle, centre;  // of the shape, in its units, and of its place
  };

  static Size size_of(const PlaneRecord& record) {
    const auto [lower, upper] = bounds_of(record);
    const double wide = upper[0] - lower[0], high = upper[1] - lower[1];
    const double room = kWidth * (1 - 2 * kMargin);
    const double least = kLeastHeight - kBand - 2 * kMargin * kWidth,
                 most = kGreatestHeight - kBand - 2 * kMargin * kWidth;
    // The longer side fills the room; the height of the picture follows.
    double scale = wide > 0 ? room / wide : room / high;
    if (high * scale > most) scale = most / high;
    const double rows = std::clamp(high * scale, least, most);
    Size size;
    size.height = static_cast<std::uint32_t>(std::ceil(rows + 2 * kMargin * kWidth)) + kBand;
    size.scale = scale * Canvas::kSamples;
    size.middle = {lower[0] + wide / 2, lower[1] + high / 2};
    size.centre = Spot(kWidth / 2.0, (size.height - kBand) / 2.0) * Canvas::kSamples;
    return size;
  }

  Spot place(const PlanePoint& p) const {
    const double y = (p[1] - size_.middle[1]) * size_.scale;
    return size_.centre + Spot((p[0] - size_.middle[0]) * size_.scale, record_.y_is_down ? y : -y);
  }

  /// Paler in the middle, darker towards the rim, as the glass of solids is.
  void draw_glass() {
    std::vector<picture::AreaEdge> edges;
    edges.reserve(record_.shape.segments.size());
    for (const auto& [a, b] : record_.shape.segments) {
      edges.push_back({place(record_.shape.points[a]), place(record_.shape.points[b])});
    }
    const std::vector<bool> is_inside = picture::inside_of(edges, canvas_.width(), canvas_.height());
    const std::vector<float> depths = picture::depths_of(is_inside, canvas_.width(), canvas_.height());
    for (std::uint32_t y = 0; y < canvas_.height(); ++y) {
      for (std::uint32_t x = 0; x < canvas_.width(); ++x) {
        const float depth = depths[std::size_t{y} * canvas_.width() + x];
        if (!(depth > 0)) continue;
        const float rim = 0.75f * std::exp(-depth / 4.0f) + 0.25f * std::exp(-depth / 26.0f);
        canvas_.blend(x, y, kGlass + rim * (kRim - kGlass), 1);
      }
    }
  }

  /// Large discs outside of the shape would cross the numbers.
  bool has_room(const Spot& centre, double radius) const {
    const double bottom = static_cast<double>(size_.height - kBand) * Canvas::kSamples;
    return centre[0] >= radius && centre[0] + radius <= canvas_.width() && centre[1] >= radius &&
           centre[1] + radius <= bottom;
  }

  /// Discs that overlap little, the largest first.
  void draw_discs() {
    std::vector<const AxisSample*> order;
    for (const auto& line : record_.lines) {
      for (const AxisSample& sample : line) order.push_back(&sample);
    }
    std::ranges::stable_sort(order, std::greater<>(), [](const AxisSample* s) { return s->radius; });
    std::vector<std::pair<Spot, double>> drawn;
    for (const AxisSample* sample : order) {
      const double radius = sample->radius * size_.scale;
      if (drawn.size() == kMostDiscs || radius < 12) break;
      const Spot centre = place(sample->point);
      const auto overlaps = [&](const std::pair<Spot, double>& other) {
        return (other.first - centre).norm() < 0.75 * (other.second + radius);
      };
      if (!has_room(centre, radius) || std::ranges::any_of(drawn, overlaps)) continue;
      drawn.emplace_back(centre, radius);
      canvas_.disc(centre, radius, Vector3f::Ones(), 0.22f);
      canvas_.circle(centre, radius, 2.2, kRim, 0.75f);
    }
  }

  /// Of a value, from 0 to 1.
  double place_in_range(double value) const { return greatest_ > least_ ? (value - least_) / (greatest_ - least_) : 0; }

  /// Thinner where there are many.
  double half_width() const {
    const auto count = static_cast<double>(record_.axis.branches.size());
    return std::clamp(5.5 - 0.9 * std::log10(1 + count), 1.6, 5.0);
  }

  void draw_branches() {
    const double width = half_width();
    for (const bool is_halo : {true, false}) {
      for (const auto& line : record_.lines) {
        for (std::size_t i = 1; i < line.size(); ++i) {
          const double first = coloured_value(record_, line[i - 1]), last = coloured_value(record_, line[i]);
          const auto colour = [&](double share) -> Vector3f {
            if (is_halo) return Vector3f::Ones();
            return branch_colour(place_in_range(first + share * (last - first)));
          };
          canvas_.stroke(place(line[i - 1].point), place(line[i].point), (is_halo ? 1.55 : 1) * width, colour);
        }
      }
    }
  }

  /// On no branch: in the colours of branches.
  void draw_single_points() {
    const double range = greatest_ > least_ ? greatest_ - least_ : 1;
    for (const AxisNode& node : record_.axis.nodes) {
      if (node.degree > 0) continue;
      const double value = record_.colour == PlaneColour::kRadius ? node.radius : node.object_angle;
      canvas_.disc(place(node.point), half_width(), branch_colour((value - least_) / range), 1);
    }
  }

  /// Junctions as rings, ends as dots; none where they would cover the branches.
  void draw_marks() {
    const auto& nodes = record_.axis.nodes;
    const auto is_marked = [](const AxisNode& n) { return n.degree != 2 && n.degree != 0; };
    if (static_cast<std::size_t>(std::ranges::count_if(nodes, is_marked)) > kMostMarks) return;
    const double width = half_width();
    for (const AxisNode& node : nodes) {
      if (!is_marked(node)) continue;
      const Spot at = place(node.point);
      if (node.degree == 1) {
        canvas_.disc(at, 1.35 * width, kInk, 1);
      } else {
        canvas_.disc(at, 2.0 * width, kInk, 1);
        canvas_.disc(at, 1.25 * width, Vector3f::Ones(), 1);
      }
    }
  }

  /// On top of everything, since it is what the picture is for.
  void draw_path() {
    if (!record_.path) return;
    const std::vector<PlanePoint>& line = record_.path->line;
    for (const bool is_halo : {true, false}) {
      const auto colour = [&](double) -> Vector3f { return is_halo ? Vector3f::Ones() : kPathColour; };
      for (std::size_t i = 1; i < line.size(); ++i) {
        canvas_.stroke(place(line[i - 1]), place(line[i]), is_halo ? 7 : 4, colour);
      }
    }
  }

  /// Numbers at the lower left, the bar of colours at the lower right.
  void write_numbers(Picture& out) const {
    const PlaneCounts counts = counts_of(record_);
    picture::Scene scene;
    scene.palette = {kInk};
    if (record_.published) {
      scene.legend.title = fmt::format("{} points in {} discs, as published", counts.points, record_.published->discs);
      scene.legend.swatches.emplace_back(scene.palette.size(),
                                         fmt::format("{} segments", record_.shape.segments.size()));
    } else {
      scene.legend.title =
          fmt::format("{} branch{}, {} junction{}, {} end{}", counts.branches, counts.branches == 1 ? "" : "es",
                      counts.junctions, counts.junctions == 1 ? "" : "s", counts.ends, counts.ends == 1 ? "" : "s");
      scene.legend.swatches.emplace_back(
          scene.palette.size(),
          fmt::format("{} segments, length of the axis {:.4g}", record_.shape.segments.size(), counts.length));
    }
    scene.legend.note = fmt::format("radius {:.4g} to {:.4g}, object angle at least {:.3g}", counts.least_radius,
                                    counts.greatest_radius, record_.options.object_angle);
    picture::draw_legend(scene, out, picture::LegendCorner::kLowerLeft);
    picture::Scene bar;
    constexpr int kColoursOfBar = 10;
    for (int i = 0; i < kColoursOfBar; ++i) bar.palette.push_back(branch_colour(i / (kColoursOfBar - 1.0)));
    const bool by_radius = record_.colour == PlaneColour::kRadius;
    bar.legend = {by_radius ? "radius" : "object angle (radians)",
                  fmt::format("{:.4g}", least_),
                  fmt::format("{:.4g}", greatest_),
                  {}};
    picture::draw_legend(bar, out);
  }

  const PlaneRecord& record_;
  Size size_;
  Canvas canvas_;
  double least_ = 0, greatest_ = 0;
};

}  // namespace

Picture draw_plane(const PlaneRecord& record) { return PlanePainter(record).draw(); }

}  // namespace medial_vk
