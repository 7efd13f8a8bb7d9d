// Curvatures from medial balls against formulas, beside the source's finite differences and Rusinkiewicz's method at
// the vertices: the table of docs/accuracy.md. bench/run_curvature runs it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "medial_vk/medial_vk.h"
#include "mesh_curvature.h"
#include "smooth_boundaries.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;

constexpr double kReported = 0.6;  // the least object angle of the balls whose tips count
constexpr double kDegrees = 180 / std::numbers::pi;

struct Settings {
  std::vector<std::string> solids = {"triaxial", "oblate", "pipe", "plate", "flat torus", "tight torus"};
  std::uint32_t triangles = 16000, resolution = 160;
  double object_angle = 0.3, jitter = 0;
  unsigned threads = 0;
  bool vertices = false;
};

double angle_between(const Point& a, const Point& b) { return kDegrees * std::atan2(length(cross(a, b)), dot(a, b)); }

class Numbers {
 public:
  void add(double value) { values_.push_back(value); }
  double mean() const {
    double sum = 0;
    for (const double value : values_) sum += value;
    return sum / static_cast<double>(std::max<std::size_t>(1, values_.size()));
  }
  double quantile(double share) {
    if (values_.empty()) return 0;
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(values_.size()));
    const auto at = values_.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values_.size() - 1));
    std::nth_element(values_.begin(), at, values_.end());
    return *at;
  }

 private:
  std::vector<double> values_;
};

/// The errors of one method on one solid.
class Errors {
 public:
  explicit Errors(double greatest) : least_scale_(greatest / 10) {}

  void add_unknown() { ++unknown_; }
  void add(const SmoothPoint& truth, const Point& normal, const std::array<double, 2>& kappa, const Point& direction,
           double estimate) {
    const double greater = std::max(std::fabs(truth.kappa[0]), std::fabs(truth.kappa[1]));
    const double scale = std::max(greater, least_scale_);
    double worst = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const double error = std::fabs(kappa[k] - truth.kappa[k]);
      worst = std::max(worst, error);
      kappas_[k].add(100 * error / scale);
    }
    ++known_;
    if (worst <= estimate) ++below_;
    estimates_.add(100 * estimate / scale);
    normals_.add(angle_between(normal, truth.normal));
    // Where both curvatures are nearly equal, every direction is nearly principal.
    if (truth.kappa[0] - truth.kappa[1] < least_scale_ || std::isnan(direction[0])) return;
    const double angle = angle_between(direction, truth.directions[0]);
    directions_.add(std::min(angle, 180 - angle));
  }
  void print(const std::string& solid, const std::string& method) {
    const auto all = static_cast<double>(std::max<std::size_t>(1, known_ + unknown_));
    fmt::print("| {} | {} | {} | {:.1f} % | {:.2f} / {:.2f} | {:.2f} / {:.2f} | {:.1f} / {:.1f} | {:.3f} | {:.3f} | ",
               solid, method, known_, 100 * static_cast<double>(unknown_) / all, kappas_[0].mean(), kappas_[1].mean(),
               kappas_[0].quantile(0.95), kappas_[1].quantile(0.95), kappas_[0].quantile(1), kappas_[1].quantile(1),
               directions_.mean(), normals_.mean());
    if (below_ > 0) {
      fmt::print("{:.1f} % ({:.2f}) |\n", 100 * static_cast<double>(below_) / static_cast<double>(known_),
                 estimates_.quantile(0.5));
    } else {
      fmt::print(" |\n");
    }
    std::fflush(stdout);
  }

 private:
  double least_scale_;
  std::size_t known_ = 0, unknown_ = 0, below_ = 0;
  std::array<Numbers, 2> kappas_;
  Numbers directions_, normals_, estimates_;
};

std::vector<MedialSphere> extract(const SmoothBoundary& solid, const Settings& settings, Context& context) {
  auto prepared = prepare_mesh(solid.mesh);
  auto mesh = IndexedMesh::build(prepared.value().view());
  ExtractionOptions options;
  options.object_angle = settings.object_angle;
  options.resolution = settings.resolution;
  options.threads = settings.threads;
  return extract_and_certify(mesh.value(), options, context).value().extraction.spheres;
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

Point spoke_of(const std::array<float, 3>& spoke) { return {spoke[0], spoke[1], spoke[2]}; }

void measure_balls(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres, CurvatureMethod method,
                   Errors& errors, const Settings& settings) {
  std::vector<Ball> balls;
  std::vector<SpokePair> spokes;
  for (const MedialSphere& sphere : spheres) {
    balls.push_back({sphere.centre, sphere.radius});
    spokes.push_back({spoke_of(sphere.spoke_a), spoke_of(sphere.spoke_b)});
  }
  CurvatureOptions options;
  options.method = method;
  options.threads = settings.threads;
  options.smooth = solid.name != "triaxial" && solid.name != "oblate";  // as the source does if a solid is not convex
  const auto begin = std::chrono::steady_clock::now();
  const BoundaryCurvature result = measure_curvature(balls, options, spokes).value();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (static_cast<double>(spheres[i].object_angle) < kReported) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature& tip = result.balls[i].tips[side];
      const Point& given = side == 0 ? spokes[i].a : spokes[i].b;
      const Point& normal = is_known(tip.state) ? tip.normal : given;
      const SmoothPoint truth = solid.nearest(balls[i].centre + balls[i].radius * normal);
      if (!solid.is_known(truth.position)) continue;
      if (is_known(tip.state)) {
        errors.add(truth, tip.normal, tip.kappa, tip.directions[0], tip.error);
      } else {
        errors.add_unknown();
      }
    }
  }
  fmt::print(stderr, "{}: {} balls, {:.1f} s\n", solid.name, balls.size(), seconds.count());
}

/// At the vertices, from balls of every object angle.
void measure_vertices(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres,
                      CurvatureAssignment assignment, const Settings& settings, Errors& errors) {
  std::vector<Ball> balls;
  for (const MedialSphere& sphere : spheres) balls.push_back({sphere.centre, sphere.radius});
  CurvatureOptions options;
  options.threads = settings.threads;
  const BoundaryCurvature curvature = measure_curvature(balls, options).value();
  VertexCurvatureOptions vertex_options;
  vertex_options.assignment = assignment;
  vertex_options.threads = settings.threads;
  vertex_options.object_angle = settings.object_angle;
  auto mesh = IndexedMesh::build(prepare_mesh(solid.mesh).value().view());
  const auto begin = std::chrono::steady_clock::now();
  const auto result = curvature_at_vertices(mesh.value(), balls, curvature, vertex_options).value();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const auto vertices = mesh.value().view().vertices;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!solid.is_known(vertices[i])) continue;
    if (is_known(result[i].state)) {
      errors.add(solid.nearest(vertices[i]), result[i].normal, result[i].kappa, result[i].directions[0],
                 result[i].error);
    } else {
      errors.add_unknown();
    }
  }
  fmt::print(stderr, "{}: {} vertices, {:.2f} s\n", solid.name, result.size(), seconds.count());
}

void measure_solid(const std::string& name, const Settings& settings, Context& context) {
  SmoothBoundary solid = make_boundary(name, settings.triangles);
  if (settings.jitter > 0) solid.jitter(settings.jitter, 1);
  const double greatest = greatest_curvature(solid);
  const std::vector<MedialSphere> spheres = extract(solid, settings, context);
  if (settings.vertices) {
    Errors along(greatest), cells(greatest);
    measure_vertices(solid, spheres, CurvatureAssignment::kAlongSurface, settings, along);
    along.print(name, "along the surface");
    measure_vertices(solid, spheres, CurvatureAssignment::kVoronoi, settings, cells);
    cells.print(name, "cells");
    return;
  }
  Errors fits(greatest), differences(greatest), at_vertices(greatest);
  measure_balls(solid, spheres, CurvatureMethod::kFits, fits, settings);
  fits.print(name, "fits");
  measure_balls(solid, spheres, CurvatureMethod::kDifferences, differences, settings);
  differences.print(name, "differences");
  const std::vector<MeshCurvature> vertices = mesh_curvature(solid.mesh);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!solid.is_known(solid.mesh.vertices[i])) continue;
    at_vertices.add(solid.nearest(solid.mesh.vertices[i]), vertices[i].normal, vertices[i].kappa,
                    vertices[i].directions[0], std::nan(""));
  }
  at_vertices.print(name, "mesh");
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Curvatures from medial balls against formulas");
  app.add_option("--solids", settings.solids,
                 "triaxial, oblate, pipe, plate, flat torus, tight torus, slivers, lantern, capsule, disc");
  app.add_option("--triangles", settings.triangles, "about, by solid");
  app.add_option("--resolution", settings.resolution, "voxels along the longest side");
  app.add_option("--object-angle", settings.object_angle, "of the balls that are found");
  app.add_option("--jitter", settings.jitter, "vertices are moved by up to this share of their shortest edge");
  app.add_flag("--vertices", settings.vertices, "the assignments to vertices instead");
  app.add_option("--threads", settings.threads, "of the host, 0: all");
  CLI11_PARSE(app, argc, argv);
  auto context = Context::create();
  if (!context) {
    fmt::print(stderr, "{}\n", context.error().message);
    return 3;
  }
  fmt::print(
      "| solid | method | tips | unknown | mean, % | 95th percentile | greatest | direction, degrees | normal, "
      "degrees | below the estimate (its median, %) |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : settings.solids) measure_solid(name, settings, context.value());
}
