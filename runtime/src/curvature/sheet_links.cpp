#include "curvature/sheet_links.h"

#include <Eigen/Eigenvalues>

#include "base/parallel.h"
#include "curvature/meeting_balls.h"

namespace medial_vk {
namespace {

// All in spacings.
constexpr double kNormalReach = 2.5;  // some 20 balls of a sheet
constexpr double kShapeReach = 4;     // some 50
constexpr double kLinkReach = 2.2;
constexpr double kNestedReach = 20;
constexpr double kPointShare = 0.25;  // of the radius: centres nearer than this may count as one
// cos(0.25): along a sheet, the radius grows by at most the cosine of the least object angle on the way, and balls of
// angles below a quarter carry little of the boundary.
constexpr double kNestedSlope = 0.9689;
// Of the variances of centres in principal directions: a strip within kShapeReach whose second one is less than this
// share of the first is under two spacings wide.
constexpr double kCurveShare = 0.06;
// A sheet bent to a circle of the radius of its window has a third variance of 0.05 of the second.
constexpr double kFlatShare = 0.05;
constexpr double kSimilarNormals = 0.8;  // Section 5.4.2
constexpr std::size_t kFewest = 6;

/// The sums of the centres near a place, relative to it.
class Spread {
 public:
  void add(const Point& offset) {
    const Eigen::Vector3d x(offset[0], offset[1], offset[2]);
    ++count_;
    sum_ += x;
    squares_ += x * x.transpose();
    farthest_ = std::max(farthest_, x.squaredNorm());
  }
  std::size_t count() const { return count_; }
  double farthest() const { return std::sqrt(farthest_); }
  /// Variances ascending, with their directions in columns.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes() const {
    const double share = 1 / static_cast<double>(count_);
    const Eigen::Vector3d mean = share * sum_;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(share * squares_ - mean * mean.transpose());
  }

 private:
  std::size_t count_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  double farthest_ = 0;
};

Point column(const Eigen::Matrix3d& matrix, int i) { return {matrix(0, i), matrix(1, i), matrix(2, i)}; }

}  // namespace

SheetLinks::SheetLinks(std::span<const Ball> balls, double spacing, unsigned threads)
    : balls_(balls),
      spacing_(spacing),
      centres_(centres_of(balls)),
      grid_(centres_, 3 * spacing),
      shapes_(balls.size()) {
  std::vector<std::uint8_t> nested(balls.size());
  const auto count = balls.size();
  parallel_for(count, 64, threads,
               [&](std::size_t i) { nested[i] = is_nested(static_cast<std::uint32_t>(i)) ? 1 : 0; });
  for (std::size_t i = 0; i < count; ++i) {
    if (nested[i] != 0) shapes_[i].state = CurvatureState::kNested;
  }
  std::vector<LocalShape> shapes(count);
  parallel_for(count, 64, threads, [&](std::size_t i) { shapes[i] = shape_around(static_cast<std::uint32_t>(i)); });
  shapes_ = std::move(shapes);
  check_points(nested, threads);
  link(threads);
}

/// What shape_around() takes for points is one only if no other ball overlaps it: balls may be sparse.
void SheetLinks::check_points(const std::vector<std::uint8_t>& is_nested, unsigned threads) {
  const auto is_point = [](const LocalShape& shape) { return shape.state == CurvatureState::kPoint; };
  if (std::ranges::none_of(shapes_, is_point)) return;
  const MeetingBalls others(balls_, is_nested);
  parallel_for(balls_.size(), 64, threads, [&](std::size_t i) {
    const double near = std::min(kShapeReach * spacing_, kPointShare * balls_[i].radius);
    if (is_point(shapes_[i]) && others.meets_other(balls_[i], near)) shapes_[i] = {};
  });
}

bool SheetLinks::is_nested(std::uint32_t ball) const {
  bool found = false;
  const Ball& inner = balls_[ball];
  grid_.visit_within(inner.centre, kNestedReach * spacing_, [&](std::uint32_t other, double squared) {
    if (squared < 4 * spacing_ * spacing_) return;
    found = found || balls_[other].radius - inner.radius > kNestedSlope * std::sqrt(squared);
  });
  return found;
}

LocalShape SheetLinks::shape_around(std::uint32_t ball) const {
  if (shapes_[ball].state == CurvatureState::kNested) return shapes_[ball];
  Spread near, wide;
  std::size_t beyond = 0;
  const Point& centre = centres_[ball];
  grid_.visit_within(centre, 2 * kShapeReach * spacing_, [&](std::uint32_t other, double squared) {
    if (shapes_[other].state == CurvatureState::kNested) return;
    const double distance = std::sqrt(squared);
    if (distance > kShapeReach * spacing_) {
      ++beyond;
      return;
    }
    wide.add(centres_[other] - centre);
    if (distance <= kNormalReach * spacing_) near.add(centres_[other] - centre);
  });
  const bool is_apart = beyond == 0 && wide.farthest() <= kPointShare * balls_[ball].radius;
  const LocalShape point = {CurvatureState::kPoint, {0, 0, 0}, wide.farthest()};
  if (wide.count() < kFewest || wide.farthest() == 0) {
    return is_apart ? point : LocalShape{};
  }
  const auto axes = wide.axes();
  const Eigen::Vector3d& variances = axes.eigenvalues();
  if (variances[1] <= kCurveShare * variances[2]) {
    // The width itself, for half of it: that of the centres is less than that of the strip which they are scattered in.
    const double across = range_across(ball, column(axes.eigenvectors(), 1));
    return {CurvatureState::kCurve, column(axes.eigenvectors(), 2), std::min(across, spacing_)};
  }
  if (near.count() < kFewest) return {};
  const auto sheet = near.axes();
  if (sheet.eigenvalues()[0] > kFlatShare * sheet.eigenvalues()[1]) {
    return is_apart ? point : LocalShape{CurvatureState::kSeam, {0, 0, 0}, 0};
  }
  return {CurvatureState::kKnown, column(sheet.eigenvectors(), 0), 0};
}

double SheetLinks::range_across(std::uint32_t ball, const Point& axis) const {
  double lowest = 0, highest = 0;
  grid_.visit_within(centres_[ball], kShapeReach * spacing_, [&](std::uint32_t other, double) {
    if (shapes_[other].state == CurvatureState::kNested) return;
    const double across = dot(centres_[other] - centres_[ball], axis);
    lowest = std::min(lowest, across);
    highest = std::max(highest, across);
  });
  return highest - lowest;
}

bool SheetLinks::are_linked(std::uint32_t a, std::uint32_t b) const {
  const LocalShape &of_a = shapes_[a], &of_b = shapes_[b];
  if (of_a.state != CurvatureState::kKnown || of_b.state != CurvatureState::kKnown) return false;
  if (std::fabs(dot(of_a.direction, of_b.direction)) < kSimilarNormals) return false;
  const Point offset = centres_[b] - centres_[a];
  const double rise = std::max(std::fabs(dot(offset, of_a.direction)), std::fabs(dot(offset, of_b.direction)));
  return rise <= 0.35 * length(offset) + 0.1 * spacing_;
}

void SheetLinks::link(unsigned threads) {
  std::vector<std::vector<std::uint32_t>> by_ball(balls_.size());
  parallel_for(balls_.size(), 64, threads, [&](std::size_t i) {
    const auto ball = static_cast<std::uint32_t>(i);
    if (shapes_[ball].state != CurvatureState::kKnown) return;
    grid_.visit_within(centres_[ball], kLinkReach * spacing_, [&](std::uint32_t other, double) {
      if (other != ball && are_linked(ball, other)) by_ball[i].push_back(other);
    });
  });
  starts_.reserve(balls_.size() + 1);
  starts_.push_back(0);
  for (const auto& links : by_ball) starts_.push_back(starts_.back() + links.size());
  links_.reserve(starts_.back());
  for (const auto& links : by_ball) links_.insert(links_.end(), links.begin(), links.end());
}

const std::vector<SheetWindow::Member>& SheetWindow::collect(std::uint32_t ball, double radius) {
  near_.clear();
  members_.clear();
  const Point& centre = links_.centres()[ball];
  links_.grid().visit_within(centre, radius, [&](std::uint32_t other, double) {
    near_.push_back(other);
    state_[other] = 1;
  });
  open_.assign(1, ball);
  state_[ball] = 2;
  while (!open_.empty()) {
    const std::uint32_t at = open_.back();
    open_.pop_back();
    for (const std::uint32_t next : links_.linked(at)) {
      if (state_[next] != 1) continue;
      state_[next] = 2;
      open_.push_back(next);
    }
  }
  for (const std::uint32_t at : near_) {
    if (state_[at] == 2) members_.push_back({at, length(links_.centres()[at] - centre)});
    state_[at] = 0;
  }
  return members_;
}

}  // namespace medial_vk
