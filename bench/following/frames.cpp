#include "frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "../helpers.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/certify.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/check_balls.h"

namespace medial_vk::bench {
namespace {

PreparedMesh prepared_frame(const IndexedMesh& mesh, const std::vector<Point>& frame) {
  Mesh moved;
  moved.vertices = frame;
  moved.triangles.assign(mesh.view().triangles.begin(), mesh.view().triangles.end());
  return or_exit(prepare_mesh(std::move(moved)));
}

}  // namespace

IndexedMesh mesh_in_frame(const IndexedMesh& mesh, const std::vector<Point>& frame) {
  return or_exit(IndexedMesh::build(prepared_frame(mesh, frame)));
}

std::string fresh_points(const IndexedMesh& mesh, int resolution, Context& context) {
  ExtractionOptions options;
  options.resolution = resolution;
  const CertifiedExtraction found = or_exit(extract_and_certify(mesh, options, context));
  std::vector<Ball> balls;
  for (const MedialSphere& sphere : found.extraction.spheres) balls.push_back({sphere.centre, sphere.radius});
  const double solid = std::fabs(mesh.prepared().report.signed_volume);
  return fmt::format("{:.2f}", 100 * (1 - or_exit(measure_ball_union(balls)).volume / solid));
}

void BallsOutside::count(const IndexedMesh& mesh, const std::vector<Point>& frame, std::span<const Ball> balls) {
  std::vector<Ball> present;
  std::ranges::copy_if(balls, std::back_inserter(present), [](const Ball& ball) { return ball.radius > 0; });
  tested_ += present.size();
  std::uint64_t most = 0;
  for (const CheckLine& line : check_balls_inside(prepared_frame(mesh, frame), present).lines) {
    most = std::max(most, line.failed);
  }
  failed_ += most;
}

std::string BallsOutside::text() const { return tested_ == 0 ? "" : fmt::format("{} of {}", failed_, tested_); }

}  // namespace medial_vk::bench
