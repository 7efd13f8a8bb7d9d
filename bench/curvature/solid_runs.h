// The measurements that the tables are made of: balls of a solid, curvatures at their tips and at vertices.
#pragma once

#include <vector>

#include "medial_vk/medial_vk.h"
#include "smooth_boundaries.h"

namespace medial_vk::bench {

constexpr double kReported = 0.6;  ///< The least object angle of the balls whose tips count.

struct Settings {
  std::vector<std::string> solids = {"triaxial", "oblate", "pipe", "plate", "flat torus", "tight torus"};
  std::uint32_t triangles = 16000, resolution = 160;
  double object_angle = 0.3, jitter = 0;
  unsigned threads = 0;
  bool vertices = false, source = false, finer = false, exposed = false;
  std::size_t thinning = 1;
};

/// The solid of the settings with this name and number of triangles, with vertices moved as they say.
SmoothBoundary solid_of(const Settings& settings, const std::string& name, std::uint32_t triangles);

/// The greatest curvature at its vertices.
double greatest_curvature(const SmoothBoundary& solid);

std::vector<MedialSphere> extract(const SmoothBoundary& solid, const Settings& settings, Context& context);

/// Differences smooth the spokes first on solids that are not convex, as the source does.
BoundaryCurvature curvature_of(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres,
                               CurvatureMethod method, const Settings& settings);

/// One tip of a ball that counts, where the curvature of the solid is known.
struct MeasuredTip {
  SmoothPoint truth;
  TipCurvature tip;
};
std::vector<MeasuredTip> tips_of(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres,
                                 CurvatureMethod method, const Settings& settings);

/// The vertices of a mesh as the library prepares it, with the curvatures that were assigned to them.
struct MeasuredVertices {
  Mesh mesh;
  std::vector<VertexCurvature> at;
};
MeasuredVertices vertices_of(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres,
                             CurvatureMethod method, CurvatureAssignment assignment, const Settings& settings);

}  // namespace medial_vk::bench
