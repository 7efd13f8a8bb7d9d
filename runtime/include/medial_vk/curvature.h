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
  kKnown,      ///< Both curvatures.
  kCut,        ///< Both curvatures, from a window that a rim or a seam of the sheet cuts: on one side of the ball.
  kCurve,      ///< The ball lies on a medial curve: kappa[0] alone, 1 / radius, in the plane across the curve.
  kPoint,      ///< The ball lies apart from all others: the boundary is its sphere, and both curvatures 1 / radius.
  kSeam,       ///< Unknown: sheets meet here.
  kFew,        ///< Unknown: too few neighbours.
  kNested,     ///< Unknown: the ball all but lies in another one, as those at noise of the boundary do.
  kFocal,      ///< Unknown: the radial curvature condition fails, r kappa >= 1 (Definition 5.1).
  kUncertain,  ///< Unknown: windows of different widths disagree by more than a quarter of the greater curvature.
};

/// True for the states in which both curvatures and the spoke are values from fits or differences.
inline bool is_known(CurvatureState state) { return state == CurvatureState::kKnown || state == CurvatureState::kCut; }

/// The boundary at the tip of a spoke. Numbers that are not known are NaN.
struct TipCurvature {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  CurvatureState state = CurvatureState::kFew;
  Point normal = {kUnknown, kUnknown, kUnknown};  ///< The spoke: a unit vector, the outward normal at the tip.
  /// Principal curvatures, the greater one first, positive where the boundary is convex, in 1 / units of the balls.
  std::array<double, 2> kappa = {kUnknown, kUnknown};
  /// Unit vectors of the principal directions, tangent at the tip; signs are arbitrary. On a medial curve only the
  /// second one is known: the tangent of the curve.
  std::array<Point, 2> directions = {Point{kUnknown, kUnknown, kUnknown}, Point{kUnknown, kUnknown, kUnknown}};
  /// An estimate of the error of both curvatures, in the same units, which includes what the window averages away
  /// (bias). It is no bound: docs/accuracy.md has the shares of points whose error is below it.
  double error = kUnknown;
  double spread = kUnknown;        ///< The standard deviation of the curvatures by the residuals of the fit alone.
  double normal_error = kUnknown;  ///< An estimate of the error of the spoke, radians.
  double window = kUnknown;        ///< The radius of the window on the boundary, in the units of the balls.
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
/// ball or none, then only decide which tip is the first; `progress` is called on the calling thread, with the stages
/// "sheets", "tips" and "windows". Time: a millisecond of one core for each ball; memory: 3 kB for each. Does not
/// throw. Errors: kUsage (a number that is not finite, a radius that is not positive, a spoke that is not of unit
/// length, an option out of range, numbers of balls and spokes that differ, no spokes for kDifferences, 2^31 balls or
/// more), kInterrupted, kOutOfMemory.
Result<BoundaryCurvature> measure_curvature(std::span<const Ball> balls, const CurvatureOptions& options = {},
                                            std::span<const SpokePair> spokes = {}, const StageProgress& progress = {},
                                            const std::stop_token& stop = {});

}  // namespace medial_vk
