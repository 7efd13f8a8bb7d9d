#include "vertex_curvature/tip_means.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/point_ops.h"
#include "curvature/polynomial_fit.h"
#include "curvature/window_gap.h"

namespace medial_vk {
namespace {

constexpr double kLeastCosine = 0.4;  // 66 degrees, as between the tips of one fit
constexpr double kWindow = 3;         // spacings, the radius of windows of centres: about 28 balls
constexpr double kDetour = 1.5;       // paths along edges are longer than the distance, by up to a third or so
constexpr std::size_t kEnoughTips = 12;
constexpr std::size_t kLeastLinear = 6, kLeastQuadratic = 12;
// Where second moments across are less than this share of the window's, tips are on a line, and no slope across it is
// known. Near rims, where a spoke makes an angle of 0.3 with the sheet, a window is seen as narrow as 0.02.
constexpr double kLeastSpread = 0.002;

/// The widest angle around the middle in which there is none.
template <class Points>
double widest_gap(const Points& points) {
  std::vector<double> angles;
  angles.reserve(points.size());
  for (const auto& point : points) angles.push_back(std::atan2(point.y, point.x));
  std::ranges::sort(angles);
  double gap = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}

}  // namespace

/// Polynomials of degree 2, 1 or 0 over the plane, by weighted least squares; of as high a degree as the members allow.
class TipMeans::PlaneFit {
 public:
  using Row = Eigen::Matrix<double, 6, 1>;
  using Values = Eigen::Matrix<double, 3, 6>;

  PlaneFit(const std::vector<Member>& members, std::size_t least_quadratic) : members_(members) {
    Eigen::Matrix<double, 6, 6> moments = Eigen::Matrix<double, 6, 6>::Zero();
    for (const Member& m : members) moments += m.weight * row_at(m.x, m.y) * row_at(m.x, m.y).transpose();
    sum_ = moments(0, 0);
    const Eigen::Vector2d centre = moments.block<2, 1>(1, 0) / sum_;
    const Eigen::Matrix2d spread = moments.block<2, 2>(1, 1) / sum_ - centre * centre.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    if (axes.eigenvalues()[0] > 0) even_ = axes.operatorInverseSqrt();
    const bool is_wide = members.size() >= kLeastLinear && axes.eigenvalues()[0] > kLeastSpread;
    // Places on a conic, such as two lines, determine no polynomial of degree 2.
    if (is_wide && members.size() >= least_quadratic && invert<6>(moments)) return;
    if (is_wide && invert<3>(moments)) return;
    terms_ = 1;
    inverse_(0, 0) = 1 / sum_;
  }

  static Row row_at(double x, double y) {
    Row row;
    row << 1, x, y, x * x, x * y, y * y;
    return row;
  }
  bool is_linear() const { return terms_ > 1; }
  double sum() const { return sum_; }
  /// Takes coordinates to those in which the members spread evenly.
  const Eigen::Matrix2d& evenly() const { return even_; }
  /// The error of the value at the middle over that of a mean: 1 for a constant, more where it is extrapolated.
  double amplification() const { return std::sqrt(sum_ * inverse_(0, 0)); }
  /// Columns: the coefficients of the terms of row_at().
  template <class ValueOf>
  Values operator()(const ValueOf& value_of) const {
    Values moments = Values::Zero();
    for (const Member& m : members_) {
      const Eigen::Vector3d weighted = m.weight * value_of(m);
      moments += weighted * row_at(m.x, m.y).transpose();
    }
    return moments * inverse_;
  }

 private:
  /// Of the first terms. False if the places do not determine their coefficients.
  template <int Terms>
  bool invert(const Eigen::Matrix<double, 6, 6>& moments) {
    NormalEquations<Terms> equations;
    if (!equations.factor(moments.topLeftCorner<Terms, Terms>())) return false;
    for (int i = 0; i < Terms; ++i) {
      inverse_.block<Terms, 1>(0, i) = equations.solve(NormalEquations<Terms>::Vector::Unit(i));
    }
    terms_ = Terms;
    return true;
  }

  const std::vector<Member>& members_;
  Eigen::Matrix<double, 6, 6> inverse_ = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix2d even_ = Eigen::Matrix2d::Identity();
  double sum_ = 0;
  Eigen::Index terms_ = 1;
};

TipMeans::TipMeans(const SurfaceTips& tips, double spacing)
    : surface_(tips), radius_(kWindow * std::max(spacing, 1e-300)), grid_(centres_, 1) {
  centres_.reserve(tips.tips().size());
  for (const SurfaceTip& tip : tips.tips()) centres_.push_back(tip.sphere.centre);
  grid_ = PointGrid(centres_, radius_);
}

/// The tip whose ball is nearest to p.
bool TipMeans::find_nearest(const Point& p, const Point& normal, SurfaceWalk& walk, std::uint32_t& nearest) const {
  walk.go_to(kDetour * radius_);
  walk.find_tips(kEnoughTips);
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t at : walk.tips()) {
    const SurfaceTip& tip = surface_.tips()[at];
    if (tip.normal.dot(to_eigen(normal)) < kLeastCosine) continue;
    // Of two tips of one ball, the one beside p.
    const double beside = 1e-3 * length(p - tip.position);
    const double gap = length(p - tip.sphere.centre) - tip.sphere.radius + beside;
    if (gap > least || (gap == least && at > nearest)) continue;
    least = gap;
    nearest = at;
  }
  return least < std::numeric_limits<double>::infinity();
}

std::vector<TipMeans::Member> TipMeans::members(std::uint32_t nearest, const Point& middle) const {
  const std::vector<SurfaceTip>& all = surface_.tips();
  std::vector<Member> out;
  grid_.visit_within(middle, radius_, [&](std::uint32_t tip, double) {
    if (all[tip].normal.dot(all[nearest].normal) >= kLeastCosine) out.push_back({tip});
  });
  std::ranges::sort(out, [&](const Member& a, const Member& b) {
    const double of_a = all[a.tip].normal.dot(all[nearest].normal), of_b = all[b.tip].normal.dot(all[nearest].normal);
    if (all[a.tip].ball != all[b.tip].ball) return all[a.tip].ball < all[b.tip].ball;
    return of_a != of_b ? of_a > of_b : a.tip < b.tip;
  });
  // Of the two tips of a ball near a rim, the one on this side of the sheet.
  const auto same_ball = [&](const Member& a, const Member& b) { return all[a.tip].ball == all[b.tip].ball; };
  out.erase(std::unique(out.begin(), out.end(), same_ball), out.end());
  return out;
}

void TipMeans::weigh(std::vector<Member>& members, const Point& middle) const {
  std::vector<double> errors;
  errors.reserve(members.size());
  for (const Member& m : members) errors.push_back(surface_.tips()[m.tip].error);
  const auto half = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::ranges::nth_element(errors, half);
  // Estimates vary by chance: half of the median is added, so that none of them makes a tip count alone.
  const double median = *half;
  for (Member& m : members) {
    const Point offset = centres_[m.tip] - middle;
    const double taper = 1 - dot(offset, offset) / (radius_ * radius_);
    const double error = surface_.tips()[m.tip].error + 0.5 * median;
    m.weight = std::max(taper * taper, 1e-6) * (median > 0 ? median * median / (error * error) : 1);
  }
}

void TipMeans::place(std::vector<Member>& members, const Eigen::Matrix<double, 3, 2>& tangents,
                     const Point& middle) const {
  for (Member& m : members) {
    const Eigen::Vector2d at = tangents.transpose() * to_eigen(centres_[m.tip] - middle) / radius_;
    m.x = at[0];
    m.y = at[1];
  }
}

/// Where along the sheet the tip is at p: the centre of the ball that touches there. Tips are fitted as a polynomial of
/// the centres, which turns slowly where tips are far apart. `middle` itself if there is no such place near the window.
Point TipMeans::touching_centre(std::vector<Member>& members, const Point& middle, const Point& p,
                                const Eigen::Matrix<double, 3, 2>& tangents) const {
  constexpr int kSteps = 6;
  constexpr double kMostOffset = 1.5;
  weigh(members, middle);
  place(members, tangents, middle);
  const PlaneFit fit(members, kLeastQuadratic);
  if (!fit.is_linear()) return middle;
  const PlaneFit::Values tips = fit([&](const Member& m) -> Eigen::Vector3d {
    const SurfaceTip& tip = surface_.tips()[m.tip];
    return (to_eigen(tip.sphere.centre - p) + tip.sphere.radius * tip.normal) / radius_;
  });
  const PlaneFit::Values centres =
      fit([&](const Member& m) -> Eigen::Vector3d { return to_eigen(centres_[m.tip] - middle) / radius_; });
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  for (int i = 0; i < kSteps; ++i) {
    Eigen::Matrix<double, 6, 2> slopes = Eigen::Matrix<double, 6, 2>::Zero();
    slopes.col(0) << 0, 1, 0, 2 * at[0], at[1], 0;
    slopes.col(1) << 0, 0, 1, 0, at[0], 2 * at[1];
    const Eigen::Matrix2d turn = tangents.transpose() * tips * slopes;
    at -= turn.inverse() * (tangents.transpose() * (tips * PlaneFit::row_at(at[0], at[1])));
    if (!(at.norm() < kMostOffset)) return middle;
  }
  return middle + radius_ * to_point(centres * PlaneFit::row_at(at[0], at[1]));
}

TipMean TipMeans::at(const Point& p, const Point& normal, SurfaceWalk& walk) const {
  TipMean out;
  if (centres_.empty()) return out;
  std::uint32_t nearest = 0;
  if (!find_nearest(p, normal, walk, nearest)) return out;
  const Eigen::Matrix<double, 3, 2> tangents = tangents_of(surface_.tips()[nearest].normal);
  Point middle = centres_[nearest];
  std::vector<Member> found = members(nearest, middle);
  for (int i = 0; i < 2; ++i) {
    if (found.empty()) return out;  // the place was far from all centres
    middle = touching_centre(found, middle, p, tangents);
    found = members(nearest, middle);
  }
  double farthest = 0;
  for (const Member& m : found) farthest = std::max(farthest, length(surface_.tips()[m.tip].position - p));
  walk.go_to(kDetour * farthest);
  std::erase_if(found, [&](const Member& m) { return !walk.has_seen(m.tip); });
  if (!found.empty()) mean(found, middle, out);
  return out;
}

void TipMeans::mean(std::vector<Member>& members, const Point& middle, TipMean& out) const {
  const std::vector<SurfaceTip>& all = surface_.tips();
  weigh(members, middle);
  const Member& heaviest =
      *std::ranges::max_element(members, [](const Member& a, const Member& b) { return a.weight < b.weight; });
  out.heaviest = heaviest.tip;
  place(members, tangents_of(all[heaviest.tip].normal), middle);
  const auto normal_of = [&](const Member& m) { return all[m.tip].normal; };
  const Eigen::Vector3d normal = PlaneFit(members, kLeastQuadratic)(normal_of).col(0);
  if (!(normal.norm() > 0.5)) return;  // normals that cancel: there is no one surface here
  out.at.normal = normal.normalized();
  std::erase_if(members, [&](const Member& m) { return normal_of(m).dot(out.at.normal) <= 0; });
  if (members.empty()) return;

  const Eigen::Matrix<double, 3, 2> tangents = tangents_of(out.at.normal);
  place(members, tangents, middle);
  const PlaneFit fit(members, kLeastQuadratic);
  const auto shape_of_member = [&](const Member& m) -> Eigen::Vector3d {
    const Eigen::Matrix3d turn = least_rotation(normal_of(m), out.at.normal);
    const Eigen::Matrix2d s = tangents.transpose() * turn * all[m.tip].shape * turn.transpose() * tangents;
    return {s(0, 0), std::numbers::sqrt2 * s(0, 1), s(1, 1)};  // its length is the norm of s
  };
  const PlaneFit::Values shapes = fit(shape_of_member);
  double errors = 0, residuals = 0;
  for (const Member& m : members) {
    const Eigen::Vector3d fitted = shapes * PlaneFit::row_at(m.x, m.y);
    residuals += m.weight * (shape_of_member(m) - fitted).squaredNorm() / 2;
    errors += m.weight * all[m.tip].error;
  }
  const double off = shapes(1, 0) / std::numbers::sqrt2;
  Eigen::Matrix2d shape;
  shape << shapes(0, 0), off, off, shapes(2, 0);
  out.at.shape = tangents * shape * tangents.transpose();
  out.at.error = (errors / fit.sum() + std::sqrt(residuals / fit.sum())) * fit.amplification();
  if (fit.is_linear()) {
    // The rate G at which normals turn along the sheet is another measure: S = G (I + r G)^-1.
    const Eigen::Matrix2d toward = Eigen::Matrix2d::Identity() - all[out.heaviest].sphere.radius * shape;
    const Eigen::Matrix2d turn = tangents.transpose() * fit(normal_of).middleCols<2>(1) / radius_;
    const Eigen::Matrix2d difference = toward * (turn * toward - shape);
    out.at.error += (difference + difference.transpose()).norm() / (2 * std::numbers::sqrt2);
  } else {
    out.at.error += shape.norm() * shape.norm() * radius_;
  }
  // Near a rim, windows are seen from the side. Of an even disc with these weights, the standard deviation is 0.35.
  for (Member& m : members) {
    const Eigen::Vector2d even = 0.35 * fit.evenly() * Eigen::Vector2d(m.x, m.y);
    m.x = even[0];
    m.y = even[1];
  }
  out.is_found = true;
  out.is_outside = widest_gap(members) > std::numbers::pi;
  out.is_cut = out.is_outside || has_gap(members);
}

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

}  // namespace medial_vk
