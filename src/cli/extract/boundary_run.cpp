#include "cli/extract/boundary_run.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/stopwatch.h"
#include "boundary_fields/refined_mesh.h"
#include "cli/options/measures.h"
#include "common/file_extension.h"
#include "medial_vk/curvature.h"
#include "medial_vk/thickness.h"
#include "medial_vk/vertex_curvature.h"
#include "output/boundary_files/encode_boundary.h"
#include "output/charts_and_tables/thickness_histogram.h"
#include "sphere_fits/quality/surface_samples.h"

namespace medial_vk::cli {
namespace {

/// Points of equal areas. Shares of the area are known to a hundredth where walls are in few pieces.
constexpr std::size_t kPointsByArea = 10'000;

class BoundaryMeasurer {
 public:
  BoundaryMeasurer(const IndexedMesh& mesh, const Options& options, Progress& progress, std::vector<StageTime>& times)
      : mesh_(mesh), options_(options), progress_(progress), times_(times) {}

  void refine() { made_.refined = refine_mesh(mesh_.prepared().mesh, options_.boundary_edge * mesh_.longest_side()); }

  Status thickness(bool at_vertices) {
    Stopwatch stopwatch;
    ThicknessOptions how;
    how.delta = options_.thickness_delta * mesh_.longest_side();
    how.width = options_.thickness_width;
    how.wall_angle = options_.wall_angle;
    how.threads = options_.threads;
    std::vector<Point> points = sample_surface(mesh_.prepared().mesh, kPointsByArea);
    Result<std::vector<Thickness>> by_area = measure_thickness(mesh_, points, how, shown("thickness"));
    if (!by_area) return by_area.error();
    made_.record.thickness = summarise_thickness(points, by_area.value(), how);
    if (!options_.thickness_points.empty()) {
      add_thickness(made_.of_samples, by_area.value());
      made_.samples = std::move(points);
    }
    if (at_vertices) {
      Result<std::vector<Thickness>> of_vertices =
          measure_thickness(mesh_, made_.surface(mesh_).vertices, how, shown("vertices"));
      if (!of_vertices) return of_vertices.error();
      add_thickness(made_.fields, of_vertices.value());
    }
    times_.push_back({"thickness", stopwatch.lap()});
    return {};
  }

  Status curvature(std::span<const MedialSphere> spheres, double voxel_size) {
    Stopwatch stopwatch;
    std::vector<Ball> balls;
    std::vector<SpokePair> spokes;
    balls.reserve(spheres.size());
    spokes.reserve(spheres.size());
    for (const MedialSphere& sphere : spheres) {
      balls.push_back({sphere.centre, sphere.radius});
      spokes.push_back({unit(sphere.spoke_a), unit(sphere.spoke_b)});
    }
    CurvatureOptions how;
    how.spacing = voxel_size;
    how.threads = options_.threads;
    const StageProgress on_progress = [&](const char*, double done) { progress_.update("curvature", done); };
    Result<BoundaryCurvature> at_tips = measure_curvature(balls, how, spokes, on_progress);
    if (!at_tips) return at_tips.error();
    VertexCurvatureOptions to_vertices;
    to_vertices.object_angle = options_.extraction.object_angle;
    to_vertices.threads = options_.threads;
    const Result<IndexedMesh> surface = indexed_surface();
    if (!surface) return surface.error();
    Result<std::vector<VertexCurvature>> of_vertices =
        curvature_at_vertices(surface.value(), balls, at_tips.value(), to_vertices, on_progress);
    if (!of_vertices) return of_vertices.error();
    add_curvature(made_.fields, of_vertices.value(), spheres);
    made_.record.curvature = summarise_curvature(made_.surface(mesh_), made_.fields);
    times_.push_back({"curvature", stopwatch.lap()});
    return {};
  }

  MeasuredBoundary take() { return std::move(made_); }

 private:
  static Point unit(const std::array<float, 3>& spoke) {
    const double length = std::hypot(double{spoke[0]}, double{spoke[1]}, double{spoke[2]});
    return {spoke[0] / length, spoke[1] / length, spoke[2] / length};
  }

  Result<IndexedMesh> indexed_surface() const {
    if (!made_.refined) return mesh_;
    const MeshView view = {made_.refined->vertices, made_.refined->triangles, {}, mesh_.view().closed};
    return IndexedMesh::build(view, {.threads = options_.threads});
  }

  ProgressCallback shown(const char* stage) {
    return [this, stage](double done) { progress_.update(stage, done); };
  }

  const IndexedMesh& mesh_;
  const Options& options_;
  Progress& progress_;
  std::vector<StageTime>& times_;
  MeasuredBoundary made_;
};

}  // namespace

Result<MeasuredBoundary> measure_boundary(const IndexedMesh& mesh, std::span<const MedialSphere> spheres,
                                          double voxel_size, const Options& options, Progress& progress,
                                          std::vector<StageTime>& times) {
  const MeasuresOfBoundary needed = measures_of(options);
  BoundaryMeasurer measurer(mesh, options, progress, times);
  if (options.boundary_edge > 0) measurer.refine();
  if (needed.thickness) {
    if (Status status = measurer.thickness(needed.thickness_at_vertices); !status) return status.error();
  }
  if (needed.curvature) {
    if (Status status = measurer.curvature(spheres, voxel_size); !status) return status.error();
  }
  progress.clear();
  return measurer.take();
}

Status encode_boundary_files(const IndexedMesh& mesh, const MeasuredBoundary& measured, const Options& options,
                             std::vector<OutputFile>& files) {
  if (!options.thickness_histogram.empty()) {
    const ThicknessRecord& thickness = *measured.record.thickness;
    const bool is_drawing = file_extension(options.thickness_histogram) == ".svg";
    files.push_back(
        {options.thickness_histogram, is_drawing ? encode_thickness_svg(thickness) : encode_thickness_csv(thickness)});
  }
  const double delta =
      measured.record.thickness ? measured.record.thickness->delta : std::numeric_limits<double>::quiet_NaN();
  if (!options.thickness_points.empty()) {
    Result<std::string> bytes =
        encode_point_table(options.thickness_points, {measured.samples, {}, measured.of_samples, delta});
    if (!bytes) return bytes.error();
    files.push_back({options.thickness_points, std::move(bytes).value()});
  }
  if (options.boundary.empty()) return {};
  Result<std::string> bytes = encode_boundary(options.boundary, measured.surface(mesh), measured.fields,
                                              {options.ascii, boundary_colour_of(options), mesh.longest_side(), delta});
  if (!bytes) return bytes.error();
  files.push_back({options.boundary, std::move(bytes).value()});
  return {};
}

}  // namespace medial_vk::cli
