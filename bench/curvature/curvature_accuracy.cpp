// Curvatures from medial balls against formulas, beside the source's finite differences and methods at the vertices of
// meshes: the tables of docs/accuracy.md. bench/run_curvature runs it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "curvature_errors.h"
#include "exposed_errors.h"
#include "finer_mesh.h"
#include "jet_curvature.h"
#include "mesh_curvature.h"
#include "peer_check.h"
#include "solid_runs.h"
#include "source_tables.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;

void print_tips(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres, CurvatureMethod method,
                double greatest, const Settings& settings) {
  Errors errors(greatest);
  for (const auto& [truth, tip] : tips_of(solid, spheres, method, settings)) {
    if (is_known(tip.state)) {
      errors.add(truth, tip.normal, tip.kappa, tip.directions[0], tip.error);
    } else {
      errors.add_unknown();
    }
  }
  errors.print(solid.name, method == CurvatureMethod::kFits ? "fits" : "differences");
}

void print_vertices(const SmoothBoundary& solid, const MeasuredVertices& measured, double greatest,
                    const std::string& method) {
  Errors errors(greatest);
  for (std::size_t i = 0; i < measured.at.size(); ++i) {
    const Point& vertex = measured.mesh.vertices[i];
    if (!solid.is_known(vertex)) continue;
    const VertexCurvature& at = measured.at[i];
    if (is_known(at.state)) {
      errors.add(solid.nearest(vertex), at.normal, at.kappa, at.directions[0], at.error);
    } else {
      errors.add_unknown();
    }
  }
  errors.print(solid.name, method);
}

/// At the vertices; with `same` only where it has both curvatures.
void print_peers(const SmoothBoundary& solid, const Mesh& mesh, double greatest, const MeasuredVertices* same) {
  const auto print = [&](const std::vector<MeshCurvature>& peer, const std::string& method) {
    Errors errors(greatest);
    for (std::size_t i = 0; i < peer.size(); ++i) {
      if (!solid.is_known(mesh.vertices[i]) || (same != nullptr && !is_known(same->at[i].state))) continue;
      errors.add(solid.nearest(mesh.vertices[i]), peer[i].normal, peer[i].kappa, peer[i].directions[0], std::nan(""));
    }
    errors.print(solid.name, method);
  };
  print(mesh_curvature(mesh), "mesh");
  if (have_jets()) print(jet_curvature(mesh), "jets");
}

void measure_solid(const std::string& name, const Settings& settings, Context& context) {
  const SmoothBoundary solid = solid_of(settings, name, settings.triangles);
  const double greatest = greatest_curvature(solid);
  const std::vector<MedialSphere> spheres = extract(solid, settings, context);
  if (settings.exposed) return print_exposed(solid, spheres, settings);
  if (settings.vertices) {
    const auto measured = [&](CurvatureAssignment assignment) {
      return vertices_of(solid, spheres, CurvatureMethod::kFits, assignment, settings);
    };
    const MeasuredVertices along = measured(CurvatureAssignment::kAlongSurface);
    print_vertices(solid, along, greatest, "along the surface");
    print_vertices(solid, measured(CurvatureAssignment::kVoronoi), greatest, "cells");
    print_peers(solid, along.mesh, greatest, &along);
    return;
  }
  print_tips(solid, spheres, CurvatureMethod::kFits, greatest, settings);
  print_tips(solid, spheres, CurvatureMethod::kDifferences, greatest, settings);
  print_peers(solid, solid.mesh, greatest, nullptr);
}

void print_tables(const Settings& settings, Context& context) {
  if (settings.source) {
    print_cup_wall(settings, context);
    print_spheroid(settings, context);
    return;
  }
  if (settings.finer) {
    print_head_of_finer_mesh();
    for (const std::string& name : settings.solids) print_finer_mesh(name, settings, context);
    return;
  }
  if (settings.exposed) print_head_of_exposed();
  fmt::print(
      "| solid | method | tips | unknown | mean, % | 95th percentile | greatest | direction, degrees | normal, "
      "degrees | below the estimate (its median, %) |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : settings.solids) measure_solid(name, settings, context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Curvatures from medial balls against formulas");
  app.add_option("--solids", settings.solids,
                 "triaxial, oblate, pipe, plate, flat torus, tight torus, slivers, lantern, prism, capsule, disc");
  app.add_option("--triangles", settings.triangles, "about, by solid");
  app.add_option("--resolution", settings.resolution, "voxels along the longest side");
  app.add_option("--object-angle", settings.object_angle, "of the balls that are found");
  app.add_option("--jitter", settings.jitter, "vertices are moved by up to this share of their shortest edge");
  app.add_flag("--vertices", settings.vertices, "the assignments to vertices instead");
  app.add_flag("--source", settings.source, "Table 5-1 and Figure 5-6 of the source instead");
  app.add_flag("--exposed", settings.exposed, "spokes of exposed regions instead");
  app.add_option("--thinning", settings.thinning, "with --exposed: one ball of so many is left")
      ->check(CLI::PositiveNumber);
  app.add_flag("--finer", settings.finer, "changes with four times as many triangles instead");
  app.add_option("--threads", settings.threads, "of the host, 0: all");
  CLI11_PARSE(app, argc, argv);
  if (!peers_are_right()) return 1;
  auto context = Context::create();
  if (!context) {
    fmt::print(stderr, "{}\n", context.error().message);
    return 3;
  }
  print_tables(settings, context.value());
}
