// The foam of Sections 3.3 and 3.4 of S. Stolpner, "Medial Spheres for Shape Representation" (2011): bounds for the
// medial points that finitely many samples of the distance in a sphere can miss. docs/foam.md contains the proofs. The
// computation runs on the host, in double precision; a callback gives access to boundaries of any kind.
//
// A medial point is *missed* if it lies inside the sphere and no sampled segment reveals it. Its *width* is the
// greatest distance between two of its nearest boundary points (equation 3.1: 2 radius sin(object angle)), its *depth*
// is its distance from the sphere. No statement here requires the assumptions of Lemma 3.3: boundary points may
// coincide, the boundary may have edges, the sphere may touch it, and samples may lie anywhere in the sphere.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A query point (theta in Theta) and a boundary point that is nearest to it.
struct FoamSample {
  Point query;
  Point nearest;
};

/// The types of balls at the end of Section 3.3, by the position of their centres. V(A) is the Voronoi cell of site A.
enum class FoamBallKind : std::uint32_t {
  kHullVertex = 1,     ///< At a vertex of the hull, that is, at a sample: part of the empty foam up to rounding.
  kVoronoiVertex = 2,  ///< At a vertex of V(A) in the hull.
  kVoronoiEdge = 3,    ///< At an intersection of an edge of V(A) with the hull's surface.
  kVoronoiFace = 4,    ///< At an intersection of a face of V(A) with an edge of the hull.
};

/// A ball of the full foam: each of its sites lies on its sphere.
struct FoamBall {
  static constexpr std::uint32_t kNoSite = 0xffffffffu;
  Ball ball;
  FoamBallKind kind = FoamBallKind::kHullVertex;
  std::array<std::uint32_t, 4> sites = {kNoSite, kNoSite, kNoSite,
                                        kNoSite};  ///< Indices into Foam::sites(), ascending.
};

/// The foam of a set of samples. Immutable and safe to share between threads once built.
class Foam {
 public:
  /// `samples`: at least one; their queries lie in `sphere` (up to 1e-6 of its radius). The statements below hold for
  /// their convex hull; uncovered_depth() bounds the rest of the sphere.
  /// `query_error`: every sample's `nearest` is at most this far from the boundary, and the open ball around `query`
  /// with radius |query - nearest| - query_error holds no boundary point. slack() adds the rounding of double to it.
  /// Time: about sites^2 + samples * hull facets; memory: linear. Errors: kUsage (no sample, a number that is not
  /// finite, a radius that is not positive, a negative query error, a query outside), kOutOfMemory.
  static Result<Foam> build(std::span<const FoamSample> samples, const Ball& sphere, double query_error = 0);
  Foam(Foam&&) noexcept;
  Foam& operator=(Foam&&) noexcept;
  ~Foam();

  const Ball& sphere() const;
  /// The set of nearest boundary points; points that coincide up to rounding appear once.
  const std::vector<Point>& sites() const;
  /// The empty foam: one ball per sample, in their order. Their interiors, smaller by slack(), hold no boundary point.
  const std::vector<Ball>& empty_balls() const;
  /// The full foam of all sites, each ball once. The full foam of site A consists of the balls whose `sites` include A.
  const std::vector<FoamBall>& full_balls() const;
  /// query_error plus a bound of the rounding of this computation.
  double slack() const;

  /// True if x lies in the full foam grown by slack() and in no ball of the empty foam reduced by slack(). If the
  /// result is false, x is not the nearest boundary point of any medial point in the hull (Lemma 3.3).
  bool may_hold_contact(const Point& x) const;

  /// An upper bound of the width of medial points in the hull at this depth or more (3.4). It is within about 5 % of
  /// the largest distance that the foam allows between two contacts, one of them at a site, unless the region would
  /// have to be divided into too many parts. Throws std::bad_alloc.
  double width_bound(double depth = 0) const;
  /// An upper bound of the depth of medial points inside the sphere whose width is above `width` (3.4): at most the
  /// radius of the sphere, the trivial bound, in steps of 1/256 of it. Throws std::bad_alloc.
  double depth_bound(double width) const;
  /// The greatest depth of points in the sphere outside the hull.
  double uncovered_depth() const;

 private:
  class Impl;
  explicit Foam(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

/// A function that returns nearest boundary points of many points, in their order, by Scene::closest_points(),
/// Bvh::closest() or another method. If it fails, the caller fails with the same error.
using NearestPointsFunction = std::function<Result<std::vector<Point>>(std::span<const Point>)>;

/// The sphere around a cubic voxel.
Ball sphere_around_voxel(const Point& centre, double side);

/// The samples that Algorithm 3 (DECIDEMS) has examined, and its result.
struct SphereSamples {
  Ball sphere;
  std::vector<FoamSample> samples;
  /// True: a medial point of the boundary lies in the sphere (Lemma 2.2; the algorithm returns 'True'). False: unknown
  /// (it returns 'Undetermined').
  bool holds_medial_point = false;
};

struct SphereSamplingOptions {
  std::uint32_t count = 50;  ///< Spiral points on the sphere (2.3.2); the opposite of each is sampled too.
  bool deep_samples = true;  ///< Also c_in and c_out (3.2).
  double query_error = 0;    ///< The greatest error of the results of `nearest`, as in Foam::build().
};

/// Algorithm 3 on spiral points, their opposites and the deep samples. Two nearest points count as different only if a
/// boundary point lies in the ball at the far end by more than the rounding and twice the query error, so that the
/// answer 'True' is certain. Errors: kUsage (a radius that is not positive, or `nearest` returns a wrong number of
/// points), kOutOfMemory, and those of `nearest`.
Result<SphereSamples> sample_sphere(const Ball& sphere, const SphereSamplingOptions& sampling,
                                    const NearestPointsFunction& nearest);

/// One step of iterated foam sampling (3.5, problem 2): adds the centres of the full foam's balls of types 2 to 4. Such
/// a centre lies inside the sphere; its opposite, the point where the ray away from its nearest boundary point leaves
/// the sphere, is added too. Errors: those of sample_sphere().
Status refine_samples(const Foam& foam, double query_error, const NearestPointsFunction& nearest,
                      SphereSamples& samples);

}  // namespace medial_vk
