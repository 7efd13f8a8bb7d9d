#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "medial_vk/plane_centre_line.h"

namespace medial_vk {
namespace plane {
namespace {

/// How far the straight piece between two points of a curve is from the curve, or its radius from that of the curve.
double deviation(const PlaneCurve& curve, double from, double to) {
  const double width = to - from;
  switch (curve.kind) {
    case PlaneCurve::Kind::kOfPointAndSegment: {
      // The curve is (t, t^2 / 2f + f / 2): it is farthest in the middle, by width^2 / 8f along `up`. The radius is the
      // coordinate along `up`, so it deviates by no more than the point.
      const double slope = (from + to) / (2 * curve.focus);
      return width * (width / (8 * curve.focus)) / std::hypot(1, slope);
    }
    case PlaneCurve::Kind::kOfPoints: {
      // The radius is hypot(f, t), farthest from its chord where its derivative t / hypot(f, t) is the chord's slope.
      if (!(width > 0)) return 0;
      const double slope = (curve.radius_at(to) - curve.radius_at(from)) / width;
      const double at = curve.focus * slope / std::sqrt((1 - slope) * (1 + slope));
      if (!(at > from && at < to)) return 0;
      return curve.radius_at(from) + slope * (at - from) - curve.radius_at(at);
    }
    case PlaneCurve::Kind::kOfSegments:
      break;
  }
  return 0;
}

/// Appends the points of an arc after its first one, in the order of t.
void append_points(const AxisArc& arc, double step, std::vector<double>& out) {
  std::vector<double> open = {arc.t[1]};
  double from = arc.t[0];
  while (!open.empty()) {
    const double to = open.back(), middle = from + (to - from) / 2;
    if (deviation(arc.curve, from, to) > step && middle > from && middle < to) {
      open.push_back(middle);
      continue;
    }
    out.push_back(to);
    from = to;
    open.pop_back();
  }
}

AxisSample sample_at(const PlaneCurve& curve, double t) {
  return {curve.point_at(t), curve.radius_at(t), curve.object_angle_at(t)};
}

PlanePoint plus(const PlanePoint& p, double share, const PlanePoint& q) {
  return {p[0] + share * q[0], p[1] + share * q[1]};
}
PlanePoint minus(const PlanePoint& p, const PlanePoint& q) { return plus(p, -1, q); }
double length_of(const PlanePoint& p) { return std::hypot(p[0], p[1]); }

/// A walk along a polyline, forwards.
class Walk {
 public:
  explicit Walk(const std::vector<AxisSample>& line)
      : line_(line), piece_(length_of(minus(line[1].point, line[0].point))) {}

  /// The point at a length from the beginning.
  AxisSample at(double length) {
    go_to(length);
    const AxisSample &a = line_[next_ - 1], &b = line_[next_];
    const double share = share_at(length);
    return {plus(a.point, share, minus(b.point, a.point)), a.radius + share * (b.radius - a.radius),
            a.object_angle + share * (b.object_angle - a.object_angle)};
  }

  /// The integral of the way from the first point to the point, over the length up to there.
  PlanePoint integral(double length) {
    go_to(length);
    return plus(sum_, 1, part_of_piece(share_at(length)));
  }

 private:
  void go_to(double length) {
    while (next_ + 1 < line_.size() && begin_ + piece_ < length) {
      sum_ = plus(sum_, 1, part_of_piece(1));
      begin_ += piece_;
      ++next_;
      piece_ = length_of(minus(line_[next_].point, line_[next_ - 1].point));
    }
  }

  double share_at(double length) const { return piece_ > 0 ? std::min((length - begin_) / piece_, 1.0) : 1; }

  PlanePoint part_of_piece(double share) const {
    const PlanePoint &a = line_[next_ - 1].point, &b = line_[next_].point;
    const PlanePoint middle = minus(plus(a, share / 2, minus(b, a)), line_.front().point);
    return {share * piece_ * middle[0], share * piece_ * middle[1]};
  }

  const std::vector<AxisSample>& line_;
  std::size_t next_ = 1;
  double begin_ = 0, piece_;
  PlanePoint sum_ = {0, 0};
};

/// A polyline in pieces of equal length, and beyond its ends: a loop goes round, others are turned about their ends.
class EvenLine {
 public:
  EvenLine(const std::vector<AxisSample>& line, double spacing, bool is_loop) : is_loop_(is_loop) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i) length += length_of(minus(line[i].point, line[i - 1].point));
    constexpr double kMostPieces = 1e6;
    pieces_ = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(length / spacing), 4.0, kMostPieces));
    spacing_ = length / static_cast<double>(pieces_);
    if (!(spacing_ > 0)) return;
    set_samples(line);
    set_means(line);
  }

  std::ptrdiff_t pieces() const { return pieces_; }
  double spacing() const { return spacing_; }
  const AxisSample& operator[](std::ptrdiff_t i) const { return samples_[static_cast<std::size_t>(i)]; }

  /// The mean of the line over a spacing around a place, so that nothing shorter is overlooked.
  PlanePoint mean(std::ptrdiff_t i) const {
    if (is_loop_) return means_[static_cast<std::size_t>(((i % pieces_) + pieces_) % pieces_)];
    PlanePoint shift = {0, 0};
    double sign = 1;
    while (i < 0 || i > pieces_) {  // at most once for each passage of the line
      const std::ptrdiff_t end = i < 0 ? 0 : pieces_;
      shift = plus(shift, 2 * sign, (*this)[end].point);
      sign = -sign;
      i = 2 * end - i;
    }
    return plus(shift, sign, means_[static_cast<std::size_t>(i)]);
  }

 private:
  void set_samples(const std::vector<AxisSample>& line) {
    Walk walk(line);
    samples_.reserve(static_cast<std::size_t>(pieces_) + 1);
    for (std::ptrdiff_t k = 0; k < pieces_; ++k) samples_.push_back(walk.at(static_cast<double>(k) * spacing_));
    samples_.push_back(line.back());
  }

  void set_means(const std::vector<AxisSample>& line) {
    Walk walk(line);
    means_.reserve(samples_.size());
    PlanePoint before = {0, 0}, first = {0, 0};
    for (std::ptrdiff_t k = 0; k < pieces_; ++k) {
      const PlanePoint here = walk.integral((static_cast<double>(k) + 0.5) * spacing_);
      if (k == 0) first = here;
      const PlanePoint part = minus(here, before);
      means_.push_back(k == 0 ? line.front().point : plus(line.front().point, 1 / spacing_, part));
      before = here;
    }
    means_.push_back(line.back().point);
    if (!is_loop_) return;
    const PlanePoint rest = minus(walk.integral(static_cast<double>(pieces_) * spacing_), before);
    means_.front() = plus(line.front().point, 1 / spacing_, plus(first, 1, rest));
  }

  std::vector<AxisSample> samples_;
  std::vector<PlanePoint> means_;
  std::ptrdiff_t pieces_ = 0;
  double spacing_ = 0;
  bool is_loop_;
};

/// Halves of a Gaussian, from its middle, so that all weights sum to 1.
std::vector<double> weights_of(double width, double spacing) {
  constexpr double kReach = 3;  // standard deviations; what is left out is 0.3 percent
  const auto count = static_cast<std::size_t>(std::ceil(kReach * width / spacing));
  std::vector<double> weights;
  weights.reserve(count + 1);
  double sum = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const double x = static_cast<double>(i) * spacing / width;
    weights.push_back(std::exp(-x * x / 2));
    sum += weights.back() * (i == 0 ? 1 : 2);
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

AxisSample averaged(const EvenLine& line, std::ptrdiff_t i, const std::vector<double>& weights) {
  AxisSample sample = line[i];
  // Of differences, so that far from 0 nothing is lost.
  PlanePoint shift = {0, 0};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const auto off = static_cast<std::ptrdiff_t>(k);
    shift = plus(shift, weights[k], minus(line.mean(i + off), sample.point));
    if (k > 0) shift = plus(shift, weights[k], minus(line.mean(i - off), sample.point));
  }
  const double moved = length_of(shift), most = sample.radius / 2;
  if (moved > most) shift = {shift[0] * (most / moved), shift[1] * (most / moved)};
  sample.point = plus(sample.point, 1, shift);
  sample.radius -= std::min(moved, most);
  return sample;
}

}  // namespace
}  // namespace plane

std::vector<AxisSample> sample_branch(const PlaneAxis& axis, const AxisBranch& branch, double step) {
  std::vector<AxisSample> line;
  std::vector<double> parameters;
  for (std::size_t i = 0; i < branch.arcs.size(); ++i) {
    const AxisArc& arc = axis.arcs[branch.arcs[i]];
    parameters.assign(1, arc.t[0]);
    plane::append_points(arc, step, parameters);
    if (branch.reversed[i]) std::ranges::reverse(parameters);
    std::size_t first = 0;
    if (!line.empty()) {  // the common point of two arcs
      line.back().object_angle = std::max(line.back().object_angle, arc.curve.object_angle_at(parameters[0]));
      first = 1;
    }
    for (std::size_t k = first; k < parameters.size(); ++k) {
      line.push_back(plane::sample_at(arc.curve, parameters[k]));
    }
    // Exactly where the node is, so that the branches at it have a common point.
    const auto take_node = [&](AxisSample& sample, std::uint32_t node) {
      sample.point = axis.nodes[node].point;
      sample.radius = axis.nodes[node].radius;
    };
    if (first == 0) take_node(line.front(), arc.nodes[branch.reversed[i] ? 1 : 0]);
    take_node(line.back(), arc.nodes[branch.reversed[i] ? 0 : 1]);
  }
  return line;
}

std::vector<AxisSample> smooth_polyline(const std::vector<AxisSample>& line, double width, bool is_loop) {
  if (line.size() < 2) return line;
  const plane::EvenLine even(line, width / 4, is_loop);
  if (!(even.spacing() > 0)) return line;
  // Short lines are straight long before a wider Gaussian is.
  const double most = even.spacing() * static_cast<double>(even.pieces());
  const std::vector<double> weights = plane::weights_of(std::min(width, most), even.spacing());
  std::vector<AxisSample> smooth;
  smooth.reserve(static_cast<std::size_t>(even.pieces()) + 1);
  for (std::ptrdiff_t i = 0; i <= even.pieces(); ++i) smooth.push_back(plane::averaged(even, i, weights));
  if (!is_loop) {
    smooth.front() = line.front();
    smooth.back() = line.back();
  } else {
    smooth.back() = smooth.front();
  }
  return smooth;
}

}  // namespace medial_vk
