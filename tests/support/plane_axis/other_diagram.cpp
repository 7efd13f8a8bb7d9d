#include "support/plane_axis/other_diagram.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "support/plane_axis/exact_distances.h"

namespace medial_vk::test {
namespace {

// In longest sides. Vertices of others are made exact to some roundings below, and so are those of the axis.
constexpr double kNear = 0x1p-34;
// A vertex is found to about the rounding of its distances, 2^-43 (the library's), over the least change that a step
// makes in their differences. Farther than kMostSlide it says nothing about the place along the axis.
constexpr double kRounding = 0x1p-40, kMostSlide = 0x1p-14;
// Object angles this much above the threshold are wanted, of vertices that rounding may move.
constexpr double kAbove = 0.01;

PlanePoint step_along(const PlanePoint& a, const PlanePoint& b, double share) {
  return {a[0] + share * b[0], a[1] + share * b[1]};
}
double length_between(const PlanePoint& a, const PlanePoint& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// A contact from a point: distance, and the unit direction away from it, along which the distance grows.
struct Seen {
  double distance = 0;
  PlanePoint away = {};
};

class Comparison {
 public:
  Comparison(const PreparedShape& shape, const OtherDiagram& other, double scale, double object_angle,
             std::vector<std::string>& words)
      : shape_(shape), other_(other), scale_(scale), angle_(object_angle), words_(words) {
    size_ = shape.report.longest_side();
  }

  ComparisonCounts run() {
    PlaneAxisOptions options;
    options.object_angle = angle_;
    options.threads = 1;
    auto axis = find_plane_axis(shape_, options);
    counts_.shapes = 1;
    counts_.segments = shape_.segments.size();
    if (!axis) {
      ++counts_.missed_nodes;
      words_.push_back(axis.error().message);
      return counts_;
    }
    axis_ = std::move(axis).value();
    counts_.nodes = axis_.nodes.size();
    counts_.arcs = axis_.arcs.size();
    check_vertices();
    check_edges();
    check_nodes();
    check_arcs();
    return counts_;
  }

 private:
  struct Vertex {
    PlanePoint point = {};
    double radius = 0, object_angle = 0;
    double slide = 0;  // how far rounding may move it
    bool is_inside = false;
  };

  void say(const char* what, const PlanePoint& x, double measure) {
    std::ostringstream text;
    text.precision(17);
    text << what << " at " << x[0] << ' ' << x[1] << ": " << measure;
    words_.push_back(text.str());
  }

  bool is_end(const PlaneContact& point, const PlaneContact& line) const {
    if (!point.is_point || line.is_point) return false;
    const auto& ends = shape_.segments[line.index];
    return ends[0] == point.index || ends[1] == point.index;
  }
  PlanePoint along_of(const PlaneContact& line) const {
    const auto& [a, b] = shape_.segments[line.index];
    const double length = length_between(shape_.points[a], shape_.points[b]);
    return {(shape_.points[b][0] - shape_.points[a][0]) / length, (shape_.points[b][1] - shape_.points[a][1]) / length};
  }

  Seen see(PlaneContact contact, const PlanePoint& x) const {
    if (!contact.is_point) {  // its line
      const PlanePoint u = along_of(contact), a = shape_.points[shape_.segments[contact.index][0]];
      const double height = u[0] * (x[1] - a[1]) - u[1] * (x[0] - a[0]), sign = height < 0 ? -1 : 1;
      return {std::fabs(height), {-sign * u[1], sign * u[0]}};
    }
    const PlanePoint& foot = shape_.points[contact.index];
    const double d = length_between(foot, x);
    return {d, d > 0 ? PlanePoint{(x[0] - foot[0]) / d, (x[1] - foot[1]) / d} : PlanePoint{0, 0}};
  }

  /// Steps of Newton's method on the differences of distances, in the sense of least squares.
  Vertex made_exact(const OtherDiagram::Vertex& given) const {
    Vertex result;
    result.point = {scale_ * given.point[0], scale_ * given.point[1]};
    double least = 0;  // eigenvalue of the sum of squares
    std::vector<Seen> seen(given.contacts.size());
    for (int step = 0; step < 4; ++step) {
      double xx = 0, xy = 0, yy = 0, bx = 0, by = 0, mean = 0;
      PlanePoint middle = {0, 0};
      for (std::size_t i = 0; i < seen.size(); ++i) {
        seen[i] = see(given.contacts[i], result.point);
        mean += seen[i].distance / static_cast<double>(seen.size());
        middle = step_along(middle, seen[i].away, 1 / static_cast<double>(seen.size()));
      }
      for (const Seen& s : seen) {
        const double ux = s.away[0] - middle[0], uy = s.away[1] - middle[1], off = s.distance - mean;
        xx += ux * ux;
        xy += ux * uy;
        yy += uy * uy;
        bx -= ux * off;
        by -= uy * off;
      }
      // A segment and its end: on the normal at that end.
      for (const PlaneContact& line : given.contacts) {
        for (const PlaneContact& point : given.contacts) {
          if (!is_end(point, line)) continue;
          const PlanePoint along = along_of(line);
          const PlanePoint from = step_along(result.point, shape_.points[point.index], -1);
          const double off = along[0] * from[0] + along[1] * from[1];
          xx += along[0] * along[0];
          xy += along[0] * along[1];
          yy += along[1] * along[1];
          bx -= along[0] * off;
          by -= along[1] * off;
        }
      }
      const double det = xx * yy - xy * xy, half = (xx + yy) / 2;
      least = half > 0 ? det / (half + std::sqrt(std::max(0.0, half * half - det))) : 0;
      result.radius = mean;
      if (step == 3 || !(least > 0x1p-60)) break;
      result.point = step_along(result.point, {(yy * bx - xy * by) / det, (xx * by - xy * bx) / det}, 1);
    }
    result.slide = least > 0x1p-60 ? kRounding * size_ / std::sqrt(least) : size_;
    for (const Seen& a : seen) {
      for (const Seen& b : seen) {
        const double turn = std::fabs(
            std::atan2(a.away[0] * b.away[1] - a.away[1] * b.away[0], a.away[0] * b.away[0] + a.away[1] * b.away[1]));
        result.object_angle = std::max(result.object_angle, turn / 2);
      }
    }
    return result;
  }

  /// An upper bound, exact to first order near the axis.
  double distance_from_axis(const PlanePoint& x) const {
    double best = std::numeric_limits<double>::infinity();
    for (const AxisNode& node : axis_.nodes) best = std::min(best, length_between(node.point, x));
    for (const AxisArc& arc : axis_.arcs) {
      const PlaneCurve& curve = arc.curve;
      const double along = curve.along[0] * (x[0] - curve.origin[0]) + curve.along[1] * (x[1] - curve.origin[1]);
      best = std::min(best, length_between(curve.point_at(std::clamp(along, arc.t[0], arc.t[1])), x));
    }
    return best;
  }

  void check_vertices() {
    for (const OtherDiagram::Vertex& given : other_.vertices) {
      Vertex vertex = made_exact(given);
      if (length_between(vertex.point, {scale_ * given.point[0], scale_ * given.point[1]}) > 1e-3 * size_) {
        vertex.point = {scale_ * given.point[0], scale_ * given.point[1]};
        vertex.slide = size_;
      }
      vertex.is_inside = vertex.radius > kNear * size_ && is_inside(shape_, vertex.point);
      vertices_.push_back(vertex);
      if (!vertex.is_inside || vertex.object_angle < angle_ + kAbove) continue;
      if (vertex.slide > kMostSlide * size_) {
        ++counts_.slides;
        continue;
      }
      if (nearest_point(shape_, vertex.point).distance < vertex.radius - vertex.slide - kNear * size_) {
        ++counts_.other_is_wrong;
        continue;
      }
      ++counts_.vertices;
      const double distance = distance_from_axis(vertex.point);
      counts_.farthest = std::max(counts_.farthest, distance / size_);
      if (distance > kNear * size_ + vertex.slide) {
        ++counts_.missed_vertices;
        say("missed vertex", vertex.point, distance / size_);
      }
      const auto is_here = [&](const AxisNode& n) {
        return length_between(n.point, vertex.point) <= kNear * size_ + 2 * vertex.slide;
      };
      if (std::ranges::none_of(axis_.nodes, is_here)) {
        ++counts_.missed_nodes;
        say("no node", vertex.point, vertex.object_angle);
      }
    }
  }

  /// The middle of an edge, moved onto the points that are equally far from both contacts.
  std::optional<PlanePoint> middle_of(const OtherDiagram::Edge& edge) const {
    const PlanePoint &a = vertices_[edge.vertices[0]].point, &b = vertices_[edge.vertices[1]].point;
    PlanePoint x = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    for (int step = 0; step < 6; ++step) {
      const Seen s = see(edge.contacts[0], x), t = see(edge.contacts[1], x);
      const PlanePoint gradient = step_along(s.away, t.away, -1);
      const double squared = gradient[0] * gradient[0] + gradient[1] * gradient[1];
      if (!(squared > 0x1p-40)) return {};
      x = step_along(x, gradient, -(s.distance - t.distance) / squared);
    }
    return x;
  }

  void check_edges() {
    for (const OtherDiagram::Edge& edge : other_.edges) {
      const Vertex &a = vertices_[edge.vertices[0]], &b = vertices_[edge.vertices[1]];
      if (length_between(a.point, b.point) < 8 * kNear * size_ + a.slide + b.slide) continue;
      const std::optional<PlanePoint> x = middle_of(edge);
      if (!x) continue;
      const Seen s = see(edge.contacts[0], *x), t = see(edge.contacts[1], *x);
      const double cosine = s.away[0] * t.away[0] + s.away[1] * t.away[1];
      const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / 2;
      if (angle < angle_ + kAbove || s.distance < kNear * size_ || !is_inside(shape_, *x)) continue;
      const double nearest = nearest_point(shape_, *x).distance;
      if (nearest > s.distance + kNear * size_) continue;  // beyond the end of a segment: the middle left the edge
      if (nearest < s.distance - kNear * size_) {
        ++counts_.other_is_wrong;
        continue;
      }
      ++counts_.edges;
      const double distance = distance_from_axis(*x);
      counts_.farthest = std::max(counts_.farthest, distance / size_);
      if (distance <= kNear * size_) continue;
      ++counts_.missed_edges;
      say("missed edge", *x, distance / size_);
    }
  }

  /// Each node of ours is a vertex of theirs.
  void check_nodes() {
    for (const AxisNode& node : axis_.nodes) {
      if (node.kind != AxisNodeKind::kMeeting || node.degree == 2) continue;
      const auto is_here = [&](const Vertex& v) {
        return length_between(v.point, node.point) <= kNear * size_ + 2 * std::min(v.slide, kMostSlide * size_);
      };
      if (std::ranges::any_of(vertices_, is_here)) continue;
      ++counts_.unknown_nodes;
      say("unknown node", node.point, node.object_angle);
    }
  }

  void check_arcs() {
    for (const AxisArc& arc : axis_.arcs) {
      for (const double share : {0.1, 0.5, 0.9}) {
        const double t = arc.t[0] + share * (arc.t[1] - arc.t[0]), radius = arc.curve.radius_at(t);
        const PlanePoint x = arc.curve.point_at(t);
        const double off = std::fabs(nearest_point(shape_, x).distance - radius);
        if (off <= 1e-12 * size_ && (radius < 1e-9 * size_ || is_inside(shape_, x))) continue;
        ++counts_.wrong_arcs;
        say("wrong arc", x, off / size_);
      }
    }
  }

  const PreparedShape& shape_;
  const OtherDiagram& other_;
  double scale_, angle_, size_ = 0;
  std::vector<std::string>& words_;
  PlaneAxis axis_;
  std::vector<Vertex> vertices_;
  ComparisonCounts counts_;
};

}  // namespace

void ComparisonCounts::add(const ComparisonCounts& o) {
  using Counts = ComparisonCounts;
  for (std::uint64_t Counts::*count :
       {&Counts::shapes, &Counts::segments, &Counts::vertices, &Counts::edges, &Counts::nodes, &Counts::arcs,
        &Counts::slides, &Counts::missed_vertices, &Counts::missed_edges, &Counts::missed_nodes, &Counts::unknown_nodes,
        &Counts::wrong_arcs, &Counts::other_is_wrong}) {
    this->*count += o.*count;
  }
  farthest = std::max(farthest, o.farthest);
}

ComparisonCounts compare(const PreparedShape& shape, const OtherDiagram& other, double scale, double object_angle,
                         std::vector<std::string>& words) {
  return Comparison(shape, other, scale, object_angle, words).run();
}

}  // namespace medial_vk::test
