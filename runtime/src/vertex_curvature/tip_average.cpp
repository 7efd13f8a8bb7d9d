#include "vertex_curvature/tip_average.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "curvature/window_gap.h"

namespace medial_vk {
namespace {

constexpr double kLeastCosine = 0.4;  // 66 degrees, as between the tips of one fit
constexpr std::size_t kLeastLinear = 6;
// A plane has three numbers: where the tips' second moments across are less than this share of the window's, they are
// on a line, and no slope across it is known.
constexpr double kLeastSpread = 0.02;

struct Member {
  std::uint32_t tip;
  Eigen::Vector3d offset;
  double x = 0, y = 0, weight = 0;  ///< Coordinates in the plane, in units of the window's radius.
};

/// Values at the middle and slopes, by weighted least squares; constant if `is_linear` does not hold.
class PlaneFit {
 public:
  explicit PlaneFit(const std::vector<Member>& members) : members_(members) {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Member& m : members) {
      const Eigen::Vector3d row(1, m.x, m.y);
      moments += m.weight * row * row.transpose();
    }
    sum_ = moments(0, 0);
    centre_ = Eigen::Vector2d(moments(1, 0), moments(2, 0)) / sum_;
    const Eigen::Matrix2d spread = moments.bottomRightCorner<2, 2>() / sum_ - centre_ * centre_.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    is_linear_ = members.size() >= kLeastLinear && axes.eigenvalues()[0] > kLeastSpread;
    if (is_linear_) inverse_ = moments.inverse();
  }

  bool is_linear() const { return is_linear_; }
  double sum() const { return sum_; }
  /// Of the weighted mean of the members from the middle, in units of the window's radius.
  double offset() const { return centre_.norm(); }
  /// Columns: the value at the middle, the slopes along x and y.
  template <class ValueOf>
  Eigen::Matrix3d operator()(const ValueOf& value_of) const {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Member& m : members_) {
      const Eigen::Vector3d weighted = m.weight * value_of(m);
      moments += weighted * Eigen::RowVector3d(1, m.x, m.y);
    }
    if (is_linear_) return moments * inverse_;
    Eigen::Matrix3d constant = Eigen::Matrix3d::Zero();
    constant.col(0) = moments.col(0) / sum_;
    return constant;
  }

 private:
  const std::vector<Member>& members_;
  Eigen::Matrix3d inverse_ = Eigen::Matrix3d::Zero();
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  double sum_ = 0;
  bool is_linear_ = false;
};

/// The members of the window; weights fall to 0 at its border and with the square of the error.
std::vector<Member> members_of(std::span<const SurfaceTip> all, std::span<const std::uint32_t> tips, const Point& p,
                               const Eigen::Vector3d& normal, double radius) {
  std::vector<Member> members;
  members.reserve(tips.size());
  std::vector<double> errors;
  errors.reserve(tips.size());
  for (const std::uint32_t tip : tips) {
    const Eigen::Vector3d offset = to_eigen(all[tip].position - p);
    if (offset.squaredNorm() >= radius * radius || all[tip].normal.dot(normal) < kLeastCosine) continue;
    members.push_back({tip, offset});
    errors.push_back(all[tip].error);
  }
  if (members.empty()) return members;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::ranges::nth_element(errors, middle);
  // Estimates vary by chance: half of the median is added, so that none of them makes a tip count alone.
  const double floor = 0.5 * *middle;
  for (Member& m : members) {
    const double taper = 1 - m.offset.squaredNorm() / (radius * radius);
    const double error = all[m.tip].error + floor;
    m.weight = taper * taper / (error > 0 ? error * error / (*middle * *middle) : 1);
  }
  return members;
}

void place(std::vector<Member>& members, const Eigen::Matrix<double, 3, 2>& tangents, double radius) {
  for (Member& m : members) {
    const Eigen::Vector2d at = tangents.transpose() * m.offset / radius;
    m.x = at[0];
    m.y = at[1];
  }
}

double widest_gap(const std::vector<Member>& members) {
  std::vector<double> angles;
  angles.reserve(members.size());
  for (const Member& m : members) angles.push_back(std::atan2(m.y, m.x));
  std::ranges::sort(angles);
  double gap = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}

}  // namespace

Eigen::Matrix<double, 3, 2> tangents_of(const Eigen::Vector3d& normal) {
  Eigen::Matrix<double, 3, 2> out;
  out.col(0) = to_eigen(perpendicular_to(to_point(normal)));
  out.col(1) = normal.cross(Eigen::Vector3d(out.col(0)));
  return out;
}

Eigen::Matrix3d least_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d axis = from.cross(to);
  Eigen::Matrix3d skew;
  skew << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  return Eigen::Matrix3d::Identity() + skew + skew * skew / (1 + from.dot(to));
}

TipAverage average_tips(std::span<const SurfaceTip> all, std::span<const std::uint32_t> tips, const Point& p,
                        const Point& normal, double radius) {
  TipAverage out;
  std::vector<Member> members = members_of(all, tips, p, to_eigen(normal), radius);
  if (members.empty()) return out;
  place(members, tangents_of(to_eigen(normal)), radius);
  const auto normal_of = [&](const Member& m) { return all[m.tip].normal; };
  const Eigen::Vector3d middle = PlaneFit(members)(normal_of).col(0);
  if (!(middle.norm() > 0.5)) return out;  // normals that cancel: there is no one surface here
  out.at.normal = middle.normalized();

  const Eigen::Matrix<double, 3, 2> tangents = tangents_of(out.at.normal);
  place(members, tangents, radius);
  const PlaneFit fit(members);
  if (!std::ranges::all_of(members, [&](const Member& m) { return normal_of(m).dot(out.at.normal) > 0; })) return out;
  const auto shape_of_member = [&](const Member& m) -> Eigen::Vector3d {
    const Eigen::Matrix3d turn = least_rotation(normal_of(m), out.at.normal);
    const Eigen::Matrix2d s = tangents.transpose() * turn * all[m.tip].shape * turn.transpose() * tangents;
    return {s(0, 0), std::numbers::sqrt2 * s(0, 1), s(1, 1)};  // its length is the norm of s
  };
  const Eigen::Matrix3d shapes = fit(shape_of_member);
  double errors = 0, residuals = 0, greatest = 0;
  for (const Member& m : members) {
    const Eigen::Vector3d fitted = shapes * Eigen::Vector3d(1, m.x, m.y);
    residuals += m.weight * (shape_of_member(m) - fitted).squaredNorm() / 2;
    errors += m.weight * all[m.tip].error;
    if (m.weight > greatest) {
      greatest = m.weight;
      out.heaviest = m.tip;
    }
  }
  Eigen::Matrix2d shape;
  const double off = shapes(1, 0) / std::numbers::sqrt2;
  shape << shapes(0, 0), off, off, shapes(2, 0);
  out.at.shape = tangents * shape * tangents.transpose();
  out.at.error = errors / fit.sum() + std::sqrt(residuals / fit.sum());
  const double bend = shape.norm() * radius * fit.offset();  // radians from the tips to the vertex
  if (fit.is_linear()) {
    // The rate at which the normals turn is another measure of the same operator.
    const Eigen::Matrix<double, 3, 2> slopes = fit(normal_of).rightCols<2>() / radius;
    const Eigen::Matrix2d turn = tangents.transpose() * slopes;
    const Eigen::Matrix2d other = 0.5 * (turn + turn.transpose());
    out.at.error += (other - shape).norm() / std::numbers::sqrt2 + shape.norm() * bend * bend;
  } else {
    out.at.error += shape.norm() * bend;
  }
  out.is_found = true;
  out.is_outside = widest_gap(members) > std::numbers::pi;
  out.is_cut = out.is_outside || has_gap(members);
  return out;
}

}  // namespace medial_vk
