#include "medial_vk/vertex_curvature.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <string>

#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "indexed_mesh/bounded_mesh.h"
#include "vertex_curvature/surface_tips.h"
#include "vertex_curvature/tip_means.h"
#include "vertex_curvature/touching_balls.h"
#include "vertex_curvature/unknown_reasons.h"
#include "vertex_curvature/voronoi_means.h"

namespace medial_vk {
namespace {

constexpr double kMost = 1e18;    // as of measure_curvature()
constexpr double kMostPath = 12;  // spacings, along edges
constexpr std::size_t kCapNodes = 40;
constexpr std::size_t kVerticesAtATime = 64;
constexpr double kUncertainError = 0.25;  // as of measure_curvature()

// Radians, between the normals of the smooth boundary and of the mesh: at an edge of the solid the latter is that of
// neither face.
constexpr double kMostTurn = 0.35, kClearTurn = 0.1;

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

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
  AlongSurface(const SurfaceTips& surface, const TipMeans& means, const TouchingBalls& touching,
               const UnknownReasons& reasons, double spacing)
      : surface_(surface), means_(means), touching_(touching), reasons_(reasons), spacing_(spacing), walk_(surface) {}

  VertexCurvature at(std::uint32_t vertex) {
    VertexCurvature out = measure(vertex);
    const bool tells_why =
        out.state == CurvatureState::kFew || (out.state == CurvatureState::kEdge && !is_at_edge(vertex));
    if (tells_why) out.state = reasons_.at(surface_.mesh().vertices[vertex]);
    return out;
  }

 private:
  /// Of the mesh: where it has none, normals disagree since tips nearby are not known.
  bool is_at_edge(std::uint32_t vertex) const {
    const Eigen::Vector3d normal = to_eigen(surface_.normal(vertex));
    return std::ranges::any_of(surface_.triangles_at(vertex), [&](std::uint32_t triangle) {
      const Triangle& t = surface_.mesh().triangles[triangle];
      const std::span<const Point> vertices = surface_.mesh().vertices;
      const Point across = cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
      return angle_between(to_eigen(across), normal) >= kMostTurn;
    });
  }

  VertexCurvature measure(std::uint32_t vertex) {
    const Point& p = surface_.mesh().vertices[vertex];
    walk_.begin(vertex, kMostPath * spacing_);
    const TipMean mean = means_.at(p, surface_.normal(vertex), walk_);
    const Eigen::Vector3d normal = to_eigen(surface_.normal(vertex));
    const bool agrees = mean.is_found && angle_between(mean.at.normal, normal) < kMostTurn;
    VertexCurvature of_mean = mean.is_found ? unknown(CurvatureState::kEdge, mean) : VertexCurvature{};
    if (agrees) of_mean = of_tips(mean);
    if (is_known(of_mean.state) && !mean.is_outside) return of_mean;
    walk_.find_nodes(kCapNodes);
    around_.assign(1, p);
    for (const std::uint32_t near : walk_.nodes()) {
      if (surface_.graph().vertex(near) != vertex) around_.push_back(surface_.place(near));
    }
    const Touch touch = touching_.at(p, around_);
    if (touch.state == CurvatureState::kFew) {
      // Beyond the last tips, the normal of the mesh tells whether the boundary goes on as they say.
      const bool turns_off = agrees && mean.is_outside && angle_between(mean.at.normal, normal) >= kClearTurn;
      return turns_off ? unknown(CurvatureState::kEdge, mean) : of_mean;
    }
    if (!is_known(of_mean.state) || touch.depth > 0.5 * spacing_) return of_touch(touch);
    // At the border of a cap: the one whose normal is that of the mesh, or the better one.
    const double off = angle_between(mean.at.normal, normal) - angle_between(touch.at.normal, normal);
    if (std::fabs(off) > kClearTurn) return off > 0 ? of_touch(touch) : of_mean;
    return touch.at.error < mean.at.error ? of_touch(touch) : of_mean;
  }

  VertexCurvature of_tips(const TipMean& mean) const {
    const SurfaceTip& tip = surface_.tips()[mean.heaviest];
    VertexCurvature out;
    out.ball = tip.ball;
    out.tip = tip.side;
    VertexCurvature known = out;
    set_shape(mean.at, known);
    known.state = mean.is_cut ? CurvatureState::kCut : CurvatureState::kKnown;
    const double greater = std::max(std::fabs(known.kappa[0]), std::fabs(known.kappa[1]));
    const bool is_certain = known.error <= kUncertainError * std::max(greater, 0.1 / tip.sphere.radius);
    return is_certain ? known : unknown(CurvatureState::kUncertain, mean);
  }

  VertexCurvature unknown(CurvatureState state, const TipMean& mean) const {
    VertexCurvature out;
    out.state = state;
    out.normal = to_point(mean.at.normal);
    out.ball = surface_.tips()[mean.heaviest].ball;
    out.tip = surface_.tips()[mean.heaviest].side;
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
  const TipMeans& means_;
  const TouchingBalls& touching_;
  const UnknownReasons& reasons_;
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
  const TipMeans means(surface, curvature.spacing);
  const TouchingBalls touching(balls, curvature, options.object_angle);
  const UnknownReasons reasons(balls, curvature);
  const std::size_t count = surface.mesh().vertices.size();
  std::vector<VertexCurvature> out(count);
  parallel_blocks(count, (count + 255) / 256 + kVerticesAtATime, options.threads,
                  [&](std::size_t begin, std::size_t end) {
                    AlongSurface search(surface, means, touching, reasons, curvature.spacing);
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
    if (const Status status = check_bounded(mesh); !status) return status.error();
    if (const Status status = check_input(mesh.view(), balls, curvature, options); !status) return status.error();
    try {
      return assign(mesh, balls, curvature, options, progress, stop);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
