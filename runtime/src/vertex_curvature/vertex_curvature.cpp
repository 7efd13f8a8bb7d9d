#include "medial_vk/vertex_curvature.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <string>

#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "vertex_curvature/surface_tips.h"
#include "vertex_curvature/tip_average.h"
#include "vertex_curvature/touching_balls.h"
#include "vertex_curvature/voronoi_means.h"

namespace medial_vk {
namespace {

constexpr double kMost = 1e18;                         // as of measure_curvature()
constexpr double kLeastWindow = 2.5, kMostWindow = 8;  // spacings
constexpr double kDetour = 1.5;  // paths along edges are longer than the distance, by up to a third or so
constexpr std::size_t kEnoughTips = 12;
constexpr std::size_t kVerticesAtATime = 64;
constexpr double kUncertainError = 0.25;  // as of measure_curvature()

bool is_moderate(const Point& p) {
  return std::ranges::all_of(p, [](double x) { return std::fabs(x) <= kMost; });
}

Status check_input(const MeshView& mesh, std::span<const Ball> balls, const BoundaryCurvature& curvature,
                   const VertexCurvatureOptions& options) {
  const auto usage = [](const std::string& message) { return Error{ErrorCode::kUsage, message}; };
  if (balls.size() >= std::size_t{1} << 31) return usage("there are 2^31 balls or more");
  if (curvature.balls.size() != balls.size()) return usage("there must be as many measured curvatures as balls");
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!is_moderate(balls[i].centre) || !(balls[i].radius > 0 && balls[i].radius <= kMost)) {
      return usage("ball " + std::to_string(i) + " must have a positive radius, and no number beyond 1e18");
    }
  }
  if (!std::ranges::all_of(mesh.vertices, is_moderate)) return usage("the mesh must have no coordinate beyond 1e18");
  if (!(curvature.spacing >= 0 && curvature.spacing <= kMost)) return usage("the spacing of balls must be a length");
  if (!(options.object_angle >= 0 && options.object_angle <= std::numbers::pi / 2)) {
    return usage("the object angle must be from 0 to pi / 2");
  }
  if (options.assignment != CurvatureAssignment::kAlongSurface && options.assignment != CurvatureAssignment::kVoronoi) {
    return usage("there is no such assignment of curvatures to vertices");
  }
  return {};
}

/// Sets normal, curvatures, directions and error.
void set_shape(const PointShape& shape, VertexCurvature& out) {
  const Eigen::Matrix<double, 3, 2> tangents = tangents_of(shape.normal);
  const Eigen::Matrix2d form = tangents.transpose() * shape.shape * tangents;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(form);
  out.normal = to_point(shape.normal);
  out.error = shape.error;
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.kappa[k] = axes.eigenvalues()[1 - i];
    out.directions[k] = to_point(tangents * axes.eigenvectors().col(1 - i));
  }
}

/// The vertices of a mesh, one after the other; one object for each thread.
class AlongSurface {
 public:
  AlongSurface(const SurfaceTips& surface, const TouchingBalls& touching, std::span<const Ball> balls, double spacing)
      : surface_(surface), touching_(touching), balls_(balls), spacing_(spacing), walk_(surface) {}

  VertexCurvature at(std::uint32_t vertex) {
    const Point& p = surface_.mesh().vertices[vertex];
    const double window =
        walk_.from(vertex, kDetour * kLeastWindow * spacing_, kDetour * kMostWindow * spacing_, kEnoughTips) / kDetour;
    const TipAverage average =
        average_tips(surface_.tips(), walk_.tips(), p, surface_.normal(vertex), std::max(window, 0.0));
    if (average.is_found && !average.is_outside) return of_tips(average);
    around_.clear();
    for (const std::uint32_t near : walk_.vertices()) around_.push_back(surface_.mesh().vertices[near]);
    if (around_.empty()) around_.push_back(p);
    const Touch touch = touching_.at(p, around_);
    const bool is_nearer = touch.depth > 0.5 * spacing_ || !average.is_found || touch.at.error < average.at.error;
    if (touch.state != CurvatureState::kFew && is_nearer) return of_touch(touch);
    return average.is_found ? of_tips(average) : VertexCurvature{};
  }

 private:
  VertexCurvature of_tips(const TipAverage& average) const {
    const SurfaceTip& tip = surface_.tips()[average.heaviest];
    VertexCurvature out;
    out.ball = tip.ball;
    out.tip = tip.side;
    VertexCurvature known = out;
    set_shape(average.at, known);
    known.state = average.is_cut ? CurvatureState::kCut : CurvatureState::kKnown;
    const double greater = std::max(std::fabs(known.kappa[0]), std::fabs(known.kappa[1]));
    if (known.error <= kUncertainError * std::max(greater, 0.1 / balls_[tip.ball].radius)) return known;
    out.state = CurvatureState::kUncertain;
    out.normal = known.normal;
    return out;
  }

  static VertexCurvature of_touch(const Touch& touch) {
    VertexCurvature out;
    set_shape(touch.at, out);
    out.state = touch.state;
    out.ball = touch.ball;
    out.tip = VertexCurvature::kCap;
    if (touch.state == CurvatureState::kCurve) {
      out.kappa[1] = TipCurvature::kUnknown;
      out.directions[1] = to_point(touch.tangent);
    }
    return out;
  }

  const SurfaceTips& surface_;
  const TouchingBalls& touching_;
  std::span<const Ball> balls_;
  double spacing_;
  SurfaceWalk walk_;
  std::vector<Point> around_;
};

std::vector<VertexCurvature> assign(const IndexedMesh& mesh, std::span<const Ball> balls,
                                    const BoundaryCurvature& curvature, const VertexCurvatureOptions& options,
                                    const StageProgress& progress, const std::stop_token& stop) {
  const auto stage = [&](const char* name) -> ProgressCallback {
    if (!progress) return {};
    return [&progress, name](double done) { progress(name, done); };
  };
  const ProgressCallback placing = stage("tips on the mesh"), assigning = stage("vertices");
  LoopWatch place_watch(placing, stop), watch(assigning, stop);
  const SurfaceTips surface(mesh, balls, curvature, options.threads, place_watch);
  if (options.assignment == CurvatureAssignment::kVoronoi) {
    return voronoi_means(surface, curvature, options.threads, watch);
  }
  const TouchingBalls touching(balls, curvature, options.object_angle);
  const std::size_t count = surface.mesh().vertices.size();
  std::vector<VertexCurvature> out(count);
  parallel_blocks(count, (count + 255) / 256 + kVerticesAtATime, options.threads,
                  [&](std::size_t begin, std::size_t end) {
                    AlongSurface search(surface, touching, balls, curvature.spacing);
                    for (std::size_t v = begin; v < end; ++v) {
                      watch.check();
                      out[v] = search.at(static_cast<std::uint32_t>(v));
                    }
                    watch.finish(end - begin, count);
                  });
  return out;
}

}  // namespace

Result<std::vector<VertexCurvature>> curvature_at_vertices(const IndexedMesh& mesh, std::span<const Ball> balls,
                                                           const BoundaryCurvature& curvature,
                                                           const VertexCurvatureOptions& options,
                                                           const StageProgress& progress, const std::stop_token& stop) {
  return catch_out_of_memory("assigning curvatures to vertices", [&]() -> Result<std::vector<VertexCurvature>> {
    if (const Status status = check_input(mesh.view(), balls, curvature, options); !status) return status.error();
    try {
      return assign(mesh, balls, curvature, options, progress, stop);
    } catch (const LoopStopped&) {
      return Error{ErrorCode::kInterrupted, "interrupted"};
    }
  });
}

}  // namespace medial_vk
