#include "solid_runs.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk::bench {
namespace {

Point point_of(const std::array<float, 3>& spoke) { return {spoke[0], spoke[1], spoke[2]}; }

std::vector<Ball> balls_of(const std::vector<MedialSphere>& spheres) {
  std::vector<Ball> out;
  out.reserve(spheres.size());
  for (const MedialSphere& sphere : spheres) out.push_back({sphere.centre, sphere.radius});
  return out;
}

}  // namespace

SmoothBoundary solid_of(const Settings& settings, const std::string& name, std::uint32_t triangles) {
  SmoothBoundary solid = make_boundary(name, triangles);
  if (settings.jitter > 0) solid.jitter(settings.jitter, 1);
  return solid;
}

double greatest_curvature(const SmoothBoundary& solid) {
  double greatest = 0;
  for (const Point& vertex : solid.mesh.vertices) {
    if (!solid.is_known(vertex)) continue;
    const SmoothPoint at = solid.nearest(vertex);
    greatest = std::max({greatest, std::fabs(at.kappa[0]), std::fabs(at.kappa[1])});
  }
  return greatest;
}

std::vector<MedialSphere> extract(const SmoothBoundary& solid, const Settings& settings, Context& context) {
  auto prepared = prepare_mesh(solid.mesh);
  auto mesh = IndexedMesh::build(prepared.value().view());
  ExtractionOptions options;
  options.object_angle = settings.object_angle;
  options.resolution = settings.resolution;
  options.threads = settings.threads;
  return extract_and_certify(mesh.value(), options, context).value().extraction.spheres;
}

BoundaryCurvature curvature_of(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres,
                               CurvatureMethod method, const Settings& settings) {
  std::vector<SpokePair> spokes;
  spokes.reserve(spheres.size());
  for (const MedialSphere& sphere : spheres) spokes.push_back({point_of(sphere.spoke_a), point_of(sphere.spoke_b)});
  CurvatureOptions options;
  options.method = method;
  options.threads = settings.threads;
  options.smooth = solid.name != "triaxial" && solid.name != "oblate";
  const auto begin = std::chrono::steady_clock::now();
  BoundaryCurvature result = measure_curvature(balls_of(spheres), options, spokes).value();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  fmt::print(stderr, "{}: {} balls, {:.1f} s\n", solid.name, spheres.size(), seconds.count());
  return result;
}

std::vector<MeasuredTip> tips_of(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres,
                                 CurvatureMethod method, const Settings& settings) {
  const BoundaryCurvature curvature = curvature_of(solid, spheres, method, settings);
  std::vector<MeasuredTip> out;
  out.reserve(2 * spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (static_cast<double>(spheres[i].object_angle) < kReported) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature& tip = curvature.balls[i].tips[side];
      const Point given = point_of(side == 0 ? spheres[i].spoke_a : spheres[i].spoke_b);
      const Point& normal = is_known(tip.state) ? tip.normal : given;
      const Point at = spheres[i].centre + spheres[i].radius * normal;
      const SmoothPoint truth = solid.nearest(at);
      if (solid.is_known(at) && solid.is_known(truth.position)) out.push_back({truth, tip});
    }
  }
  return out;
}

MeasuredVertices vertices_of(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres,
                             CurvatureMethod method, CurvatureAssignment assignment, const Settings& settings) {
  const BoundaryCurvature curvature = curvature_of(solid, spheres, method, settings);
  VertexCurvatureOptions options;
  options.assignment = assignment;
  options.threads = settings.threads;
  options.object_angle = settings.object_angle;
  auto mesh = IndexedMesh::build(prepare_mesh(solid.mesh).value().view());
  const auto begin = std::chrono::steady_clock::now();
  MeasuredVertices out;
  out.at = curvature_at_vertices(mesh.value(), balls_of(spheres), curvature, options).value();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const MeshView view = mesh.value().view();
  out.mesh.vertices.assign(view.vertices.begin(), view.vertices.end());
  out.mesh.triangles.assign(view.triangles.begin(), view.triangles.end());
  fmt::print(stderr, "{}: {} vertices, {:.2f} s\n", solid.name, out.at.size(), seconds.count());
  return out;
}

}  // namespace medial_vk::bench
