#include "source_tables.h"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "curvature_errors.h"
#include "jet_curvature.h"
#include "mesh_curvature.h"

namespace medial_vk::bench {
namespace {

class WallRow {
 public:
  /// Outside the first curvature is the positive one, inside the second one the negative one; the others are zero.
  void add(const SmoothPoint& truth, const std::array<double, 2>& kappa) {
    const bool is_outside = truth.kappa[0] > -truth.kappa[1];
    (is_outside ? positive_ : negative_).add(kappa[is_outside ? 0 : 1]);
    zero_.add(kappa[is_outside ? 1 : 0]);
  }
  void print(const std::string& method, double positive, double negative) const {
    const auto share = [](const Numbers& numbers, double truth) {
      return fmt::format("{:.2f} %, {:.2f} %", 100 * std::fabs(numbers.mean() / truth - 1),
                         100 * numbers.deviation() / std::fabs(truth));
    };
    fmt::print("| {} | {} | {:.6f}, {:.6f} | {:.6f}, {:.6f} | {:.1e}, {:.1e} | {} | {} |\n", method, zero_.count(),
               positive_.mean(), positive_.deviation(), negative_.mean(), negative_.deviation(), zero_.mean(),
               zero_.deviation(), share(positive_, positive), share(negative_, negative));
    std::fflush(stdout);
  }

 private:
  Numbers positive_, negative_, zero_;
};

constexpr double kPositive = 0.069898, kNegative = -0.0875045;  // Table 5-1

void print_peer(const std::string& method, const SmoothBoundary& wall, const std::vector<MeshCurvature>& at) {
  WallRow row;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (wall.is_known(wall.mesh.vertices[i])) row.add(wall.nearest(wall.mesh.vertices[i]), at[i].kappa);
  }
  row.print(method, kPositive, kNegative);
}

}  // namespace

void print_cup_wall(const Settings& settings, Context& context) {
  const SmoothBoundary wall = solid_of(settings, "pipe", settings.triangles);
  const std::vector<MedialSphere> spheres = extract(wall, settings, context);
  fmt::print(
      "\n| method | vertices | positive: mean, deviation | negative | zero | positive: error of the mean, deviation | "
      "negative |\n|---|---|---|---|---|---|---|\n");
  const auto print = [&](const std::string& name, CurvatureMethod method, CurvatureAssignment assignment) {
    const MeasuredVertices measured = vertices_of(wall, spheres, method, assignment, settings);
    WallRow row;
    for (std::size_t i = 0; i < measured.at.size(); ++i) {
      const Point& vertex = measured.mesh.vertices[i];
      if (wall.is_known(vertex) && is_known(measured.at[i].state)) row.add(wall.nearest(vertex), measured.at[i].kappa);
    }
    row.print(name, kPositive, kNegative);
  };
  print("differences, cells", CurvatureMethod::kDifferences, CurvatureAssignment::kVoronoi);
  print("fits, along the surface", CurvatureMethod::kFits, CurvatureAssignment::kAlongSurface);
  print_peer("mesh", wall, mesh_curvature(wall.mesh));
  if (have_jets()) print_peer("jets", wall, jet_curvature(wall.mesh));
}

void print_spheroid(const Settings& settings, Context& context) {
  const SmoothBoundary spheroid = solid_of(settings, "oblate", settings.triangles);
  const std::vector<MedialSphere> spheres = extract(spheroid, settings, context);
  fmt::print("\n| method | tips | mean absolute error: κ₁ | κ₂ |\n|---|---|---|---|\n");
  for (const CurvatureMethod method : {CurvatureMethod::kDifferences, CurvatureMethod::kFits}) {
    std::array<Numbers, 2> errors;
    for (const MeasuredTip& at : tips_of(spheroid, spheres, method, settings)) {
      if (!is_known(at.tip.state)) continue;
      for (std::size_t k = 0; k < 2; ++k) errors[k].add(std::fabs(at.tip.kappa[k] - at.truth.kappa[k]));
    }
    fmt::print("| {} | {} | {:.4f} | {:.4f} |\n", method == CurvatureMethod::kFits ? "fits" : "differences",
               errors[0].count(), errors[0].mean(), errors[1].mean());
    std::fflush(stdout);
  }
}

}  // namespace medial_vk::bench
