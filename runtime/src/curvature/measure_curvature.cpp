#include <Eigen/Eigenvalues>
#include <numbers>
#include <string>

#include "base/host_memory.h"
#include "base/parallel.h"
#include "curvature/differences.h"
#include "curvature/fit_ladder.h"
#include "medial_vk/curvature.h"

namespace medial_vk {
namespace {

// Of the difference between two windows, so that 90 % of the true errors on the solids of docs/accuracy.md are smaller.
constexpr double kErrorFactor = 3;
constexpr double kUncertainShare = 0.25;
constexpr double kMostOfAll = 1e18;  // squares and products of what is smaller stay far from the ends of double

bool is_near(double x) { return std::fabs(x) <= kMostOfAll; }  // not if NaN

bool is_near(const Point& p) { return is_near(p[0]) && is_near(p[1]) && is_near(p[2]); }

bool is_unit(const Point& p) { return std::fabs(dot(p, p) - 1) < 1e-3; }

Status check(std::span<const Ball> balls, const CurvatureOptions& options, std::span<const SpokePair> spokes) {
  const auto usage = [](const std::string& message) { return Error{ErrorCode::kUsage, message}; };
  if (balls.size() >= std::size_t{1} << 31) return usage("there are 2^31 balls or more");
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& ball = balls[i];
    if (!is_near(ball.centre) || !is_near(ball.radius) || !(ball.radius > 0)) {
      return usage("ball " + std::to_string(i) + " must have a positive radius, and no number beyond 1e18");
    }
  }
  if (!spokes.empty() && spokes.size() != balls.size()) {
    return usage("there must be as many pairs of spokes as balls, or none");
  }
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    if (!is_unit(spokes[i].a) || !is_unit(spokes[i].b)) {
      return usage("the spokes of ball " + std::to_string(i) + " must be unit vectors");
    }
  }
  if (!is_near(options.spacing) || options.spacing < 0) {
    return usage("the spacing of balls must be positive and at most 1e18, or 0 to estimate it");
  }
  if (options.method != CurvatureMethod::kFits && options.method != CurvatureMethod::kDifferences) {
    return usage("there is no such method of measuring curvature");
  }
  if (options.method == CurvatureMethod::kFits) return {};
  if (spokes.empty() && !balls.empty()) return usage("finite differences need the spokes of the balls");
  if (!is_near(options.step) || options.step < 2 * std::numbers::sqrt3) {
    return usage("the step of finite differences must be at least 2 sqrt(3) spacings, and at most 1e18");
  }
  return {};
}

/// Above this, a value is uncertain.
double greatest_error(const TipCurvature& tip, double radius) {
  return kUncertainShare * std::max({std::fabs(tip.kappa[0]), std::fabs(tip.kappa[1]), 0.1 / radius});
}

/// Curvatures and directions of a form, at a tip with this normal.
void set_axes(const TipFit& fit, TipCurvature& tip) {
  const Point x = perpendicular_to(fit.normal), y = cross(fit.normal, x);
  const Eigen::Vector3d u(x[0], x[1], x[2]), v(y[0], y[1], y[2]);
  const double off = u.dot(fit.form * v);
  Eigen::Matrix2d form;
  form << u.dot(fit.form * u), off, off, v.dot(fit.form * v);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(form);
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector2d axis = axes.eigenvectors().col(1 - i);
    tip.kappa[k] = axes.eigenvalues()[1 - i];
    tip.directions[k] = axis[0] * x + axis[1] * y;
  }
}

/// The tip with the normal of a fit.
TipCurvature with_normal(TipCurvature tip, const TipFit& fit, const WidthChoice& choice, double spacing) {
  tip.normal = fit.normal;
  tip.normal_error = kErrorFactor * choice.angle_difference;
  tip.window = kWindows[choice.step] * spacing;
  return tip;
}

/// And with its curvatures.
TipCurvature with_curvatures(TipCurvature tip, const TipFit& fit, const WidthChoice& choice) {
  set_axes(fit, tip);
  tip.error = kErrorFactor * choice.form_difference;
  tip.spread = fit.spread;
  return tip;
}

/// At the spoke of an exposed region. Fits to the tips of sheets around it are believed where their normal is one of
/// the region's, up to its own error.
TipCurvature exposed_tip(const SheetLinks& links, const FitLadder& ladder, std::size_t at, const Point& spoke,
                         double reach) {
  TipCurvature tip;
  tip.state = CurvatureState::kExposed;
  tip.normal = spoke;
  tip.normal_error = reach;
  const WidthChoice& choice = ladder.choice(at);
  if (choice.step == 0) return tip;
  const TipFit& fit = ladder.step(choice.step).fits[at];
  const double radius = links.balls()[at / 2].radius;
  const TipCurvature known = with_curvatures(with_normal(tip, fit, choice, links.spacing()), fit, choice);
  const double off = std::atan2(length(cross(fit.normal, spoke)), dot(fit.normal, spoke));
  const bool agrees = off <= reach + known.normal_error && radius * known.kappa[0] < 1;
  return agrees && known.error <= greatest_error(known, radius) ? known : tip;
}

TipCurvature tip_of(const SheetLinks& links, const FitLadder& ladder, std::uint32_t ball, std::size_t side) {
  TipCurvature tip;
  const LocalShape& shape = links.shape(ball);
  const double radius = links.balls()[ball].radius;
  tip.state = shape.state;
  if (shape.state == CurvatureState::kCurve) {
    tip.kappa[0] = 1 / radius;
    tip.directions[1] = shape.direction;
  }
  if (shape.state == CurvatureState::kPoint) tip.kappa = {1 / radius, 1 / radius};
  if (shape.state == CurvatureState::kCurve || shape.state == CurvatureState::kPoint) {
    tip.error = shape.blur / radius / radius;
  }
  const std::size_t at = 2 * std::size_t{ball} + side;
  const ExposedSpokes* exposed = ladder.exposed(ball);
  if (exposed != nullptr && side < exposed->count) {
    return exposed_tip(links, ladder, at, exposed->spokes[side], exposed->reaches[side]);
  }
  if (shape.state != CurvatureState::kKnown) return tip;
  const WidthChoice& choice = ladder.choice(at);
  tip.state = CurvatureState::kFew;
  if (choice.step == 0) return tip;
  const LadderStep& step = ladder.step(choice.step);
  const TipFit& fit = step.fits[at];
  tip = with_normal(tip, fit, choice, links.spacing());
  TipCurvature known = with_curvatures(tip, fit, choice);
  tip.state = CurvatureState::kUncertain;
  if (!(known.error <= greatest_error(known, radius))) return tip;
  tip.state = CurvatureState::kFocal;
  if (radius * known.kappa[0] >= 1) return tip;
  known.state = fit.is_cut || step.is_cut[ball] != 0 ? CurvatureState::kCut : CurvatureState::kKnown;
  return known;
}

BallCurvature ball_of(const SheetLinks& links, const FitLadder& ladder, std::uint32_t ball) {
  BallCurvature out = {{tip_of(links, ladder, ball, 0), tip_of(links, ladder, ball, 1)}, TipCurvature::kUnknown};
  const Point &u = out.tips[0].normal, &v = out.tips[1].normal;
  out.object_angle = 0.5 * std::atan2(length(cross(u, v)), dot(u, v));  // NaN if one of them is
  return out;
}

/// The tips in the order of the given spokes. What is not known of one of them leaves it to the other one.
void name_tips(const SpokePair& given, BallCurvature& ball) {
  const Point turn = given.b - given.a;
  double gain = 0;
  if (const double of_first = dot(ball.tips[0].normal, turn); !std::isnan(of_first)) gain += of_first;
  if (const double of_second = dot(ball.tips[1].normal, turn); !std::isnan(of_second)) gain -= of_second;
  if (gain > 0) std::swap(ball.tips[0], ball.tips[1]);
}

Result<BoundaryCurvature> measure(std::span<const Ball> balls, const CurvatureOptions& options,
                                  std::span<const SpokePair> spokes, const StageProgress& progress,
                                  const std::stop_token& stop) {
  BoundaryCurvature out;
  out.spacing = options.spacing > 0 ? options.spacing : estimated_spacing(centres_of(balls), options.threads);
  out.balls.resize(balls.size());
  // Balls all in one place have no spacing: none has a neighbour.
  const double spacing = out.spacing > 0 ? out.spacing : 1;
  const auto interrupted = [] { return Error{ErrorCode::kInterrupted, "interrupted"}; };
  if (options.method == CurvatureMethod::kDifferences) {
    const SpokeDifferences differences(balls, spokes, spacing, options);
    parallel_for(balls.size(), 64, options.threads, [&](std::size_t i) {
      if (!stop.stop_requested()) out.balls[i] = differences.measure(static_cast<std::uint32_t>(i));
    });
    return stop.stop_requested() ? Result<BoundaryCurvature>(interrupted()) : out;
  }
  const SheetLinks links(balls, spacing, options.threads);
  const FitLadder ladder(links, options.threads, progress, stop);
  if (stop.stop_requested()) return interrupted();
  parallel_for(balls.size(), 64, options.threads, [&](std::size_t i) {
    out.balls[i] = ball_of(links, ladder, static_cast<std::uint32_t>(i));
    if (!spokes.empty()) name_tips(spokes[i], out.balls[i]);
  });
  return out;
}

}  // namespace

Result<BoundaryCurvature> measure_curvature(std::span<const Ball> balls, const CurvatureOptions& options,
                                            std::span<const SpokePair> spokes, const StageProgress& progress,
                                            const std::stop_token& stop) {
  return catch_out_of_memory("measuring curvature", [&]() -> Result<BoundaryCurvature> {
    if (const Status status = check(balls, options, spokes); !status) return status.error();
    return measure(balls, options, spokes, progress, stop);
  });
}

}  // namespace medial_vk
