// Curvature of the boundary from medial balls alone: their two spokes, and at each tip the principal curvatures and
// directions, with an estimate of the error (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Sections 5.3
// to 5.5; docs/theory.md, "Curvature from balls").
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <stop_token>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

enum class CurvatureMethod : std::uint32_t {
  kFits,         ///< Polynomials along the sheet give the spokes, polynomials through tips the curvatures.
  kDifferences,  ///< Finite differences of the given spokes, Sections 5.4.1 to 5.4.3 of the source.
};

struct CurvatureOptions {
  CurvatureMethod method = CurvatureMethod::kFits;
  /// The mean distance of neighbouring balls along a sheet, such as the side of the voxels, in the units of the balls.
  /// 0: estimated from the centres.
  double spacing = 0;
  /// Method kDifferences: the step Delta of Section 5.4.2, as a multiple of the spacing, at least 2 sqrt(3).
  double step = 6;
  /// Method kDifferences: average the spokes of neighbours first (Section 5.4.1), for solids that are not convex.
  bool smooth = false;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.

  bool operator==(const CurvatureOptions&) const = default;
};

/// What is known of the boundary at the tip of a spoke.
enum class CurvatureState : std::uint8_t {
  kKnown,  ///< Both curvatures.
  kCut,    ///< Both curvatures, from a window that a rim or a seam of the sheet cuts: on one side of the ball.
  /// The ball lies on a medial curve, or on a strip less than two spacings wide, and touches in a circle: kappa[0]
  /// alone, 1 / radius, along that circle. The plane of the circle is perpendicular to the curve.
  kCurve,
  /// No other ball overlaps this one, but for those in it and those whose centres all but coincide with its centre: the
  /// boundary is its sphere, and both curvatures are 1 / radius.
  kPoint,
  kSeam,    ///< Unknown: sheets meet here, and no exposed region tells the spoke.
  kFew,     ///< Unknown: too few neighbours, and no exposed region tells the spoke.
  kNested,  ///< Unknown: the ball all but lies in another one, as those at noise of the boundary do.
  /// Unknown. Fits: r kappa >= 1, so that the fit is impossible (a ball that touches from inside has r kappa <= 1) or
  /// the tip is at a rim, where r kappa is 1. Differences: the radial curvature condition fails, r kappa_r >= 1
  /// (Definition 5.1).
  kFocal,
  /// Unknown. Fits: `error`, three times the difference of windows, would be above a quarter of the greater curvature
  /// or of 0.1 / r, whichever is more; they differ by more than a twelfth of that. Differences: the eigenvalues of the
  /// radial shape operator are complex.
  kUncertain,
  /// Fits: the ball lies at a seam or has too few neighbours for the gradient of its radius; the spoke is the mean
  /// direction of a part of its sphere that no other ball covers, and `normal_error` the greatest angle in that part.
  /// Where tips around it allow a fit, spoke and curvatures are those of the fit; otherwise the curvatures are NaN.
  kExposed,
  /// Of vertices alone. Unknown: the vertex is at an edge of the solid, or beyond the last tips of a sheet that does
  /// not end in a cap there.
  kEdge,
};

/// True for the states in which both curvatures and the spoke are values from fits or differences along a sheet.
inline bool is_known(CurvatureState state) { return state == CurvatureState::kKnown || state == CurvatureState::kCut; }

/// The boundary at the tip of a spoke. Numbers that are not known are NaN.
struct TipCurvature {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  CurvatureState state = CurvatureState::kFew;
  Point normal = {kUnknown, kUnknown, kUnknown};  ///< The spoke: a unit vector, the outward normal at the tip.
  /// Principal curvatures, the greater one first, positive where the boundary is convex, in 1 / units of the balls.
  std::array<double, 2> kappa = {kUnknown, kUnknown};
  /// Unit vectors of the principal directions, tangent at the tip; signs are arbitrary. On a medial curve only the
  /// second one is given, the tangent of the curve: it is tangent to the boundary, and a principal direction, only
  /// where the radius does not change. With the rate r' at which the radius changes along the curve, it lies in the
  /// plane of the principal direction and the spoke, at the angle asin |r'| from the boundary.
  std::array<Point, 2> directions = {Point{kUnknown, kUnknown, kUnknown}, Point{kUnknown, kUnknown, kUnknown}};
  /// An estimate of the error of both curvatures, in the same units, which includes what the window averages away
  /// (bias). It is no bound: docs/accuracy.md has the shares of points whose error is below it. kCurve: w / r^2, where
  /// w is half the width of the strip of centres, or more, at most a spacing; it does not cover strips with flat faces.
  /// kPoint: w / r^2, where w is the distance of the farthest centre that counts as one with that of the ball.
  /// kDifferences: the greatest difference from other steps; not known without any, or if spokes cross in one of them.
  double error = kUnknown;
  /// The standard deviation of the curvatures by the residuals of the fit alone; of kFits.
  double spread = kUnknown;
  /// An estimate of the error of the spoke, radians; of kFits. Without curvatures in the state kExposed: the greatest
  /// angle in the region: a bound if the region holds a contact, as not every one of a ball's two greatest does.
  double normal_error = kUnknown;
  double window = kUnknown;  ///< The radius of the window on the boundary, in the units of the balls.
};

struct BallCurvature {
  std::array<TipCurvature, 2> tips;
  double object_angle = TipCurvature::kUnknown;  ///< Half the angle between the two spokes, radians.
};

struct BoundaryCurvature {
  std::vector<BallCurvature> balls;  ///< By ball. Tip 0 is that of the given spoke a, if spokes are given.
  double spacing = 0;                ///< That of the options, or as estimated.
};

/// Unit vectors from the centre of a ball to its two contacts.
struct SpokePair {
  Point a, b;
};

/// Measures the boundary at both tips of each ball. Method kFits uses centres and radii alone; `spokes`, one pair per
/// ball or none, then only decide which tip is the first. Balls in another order can change results within their
/// errors: of crowded balls, those of lower numbers stay in wide windows. `progress` is called on the calling thread,
/// with the stages "sheets", "regions" (exposed ones), "tips" and "windows"; kDifferences does not call it. `stop` ends
/// the fits of sheets and tips, the search for exposed regions and the choice of windows, and the differences, within
/// some milliseconds; the estimate of the spacing, the search for neighbours, the thinning of balls and tips and the
/// smoothing of spokes run to their ends first. Time of kFits: about a third of a millisecond of one core, and memory:
/// 3 kB, for each of balls spread evenly; more where many lie within one spacing. Does not throw. Errors: kUsage (a
/// number that is not finite, a coordinate, radius, spacing or step beyond 1e18, a radius that is not positive, a spoke
/// that is not of unit length, an option out of range, numbers of balls and spokes that differ, no spokes for
/// kDifferences, 2^31 balls or more), kInterrupted, kOutOfMemory.
Result<BoundaryCurvature> measure_curvature(std::span<const Ball> balls, const CurvatureOptions& options = {},
                                            std::span<const SpokePair> spokes = {}, const StageProgress& progress = {},
                                            const std::stop_token& stop = {});

}  // namespace medial_vk
