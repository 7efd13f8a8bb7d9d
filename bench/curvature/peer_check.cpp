#include "peer_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "base/point_ops.h"
#include "curvature_errors.h"
#include "jet_curvature.h"
#include "support/solids/solids.h"

namespace medial_vk::bench {
namespace {

using Peer = std::function<std::vector<MeshCurvature>(const Mesh&)>;

constexpr double kMajor = 3, kMinor = 1;

/// The greatest error of both curvatures on a sphere, in its curvature.
double error_on_sphere(const Peer& peer, std::uint32_t triangles) {
  constexpr double kRadius = 2;
  double greatest = 0;
  for (const MeshCurvature& at : peer(test::make_sphere(kRadius, triangles))) {
    for (const double kappa : at.kappa) greatest = std::max(greatest, std::fabs(kRadius * kappa - 1));
  }
  return greatest;
}

struct TorusErrors {
  double mean = 0;     ///< Of both curvatures, in that of the tube.
  double degrees = 0;  ///< The greatest error of the first direction.
  double normals = 0;  ///< The greatest of the normals, in degrees.
};

TorusErrors errors_on_torus(const Peer& peer, std::uint32_t around) {
  const Mesh mesh = test::make_torus(kMajor, kMinor, around, 3 * around);
  const std::vector<MeshCurvature> measured = peer(mesh);
  TorusErrors out;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Point& p = mesh.vertices[i];
    const double across = std::hypot(p[0], p[1]);
    const Point centre = {kMajor * p[0] / across, kMajor * p[1] / across, 0};
    const Point normal = 1 / kMinor * (p - centre);
    // Along the tube's circle 1 / kMinor; around the axis the cosine of the normal's slope over the distance from it.
    const std::array<double, 2> kappa = {1 / kMinor, (across - kMajor) / kMinor / across};
    const Point along = {-p[1] / across, p[0] / across, 0};
    for (std::size_t k = 0; k < 2; ++k) out.mean += std::fabs(measured[i].kappa[k] - kappa[k]) * kMinor;
    const double angle = degrees_between(measured[i].directions[0], cross(normal, along));
    out.degrees = std::max(out.degrees, std::min(angle, 180 - angle));
    out.normals = std::max(out.normals, degrees_between(measured[i].normal, normal));
  }
  out.mean /= 2 * static_cast<double>(measured.size());
  return out;
}

bool expect(bool holds, const std::string& peer, const std::string& what, double value) {
  if (!holds) fmt::print(stderr, "{}: {} is {:.3g}\n", peer, what, value);
  return holds;
}

bool is_right(const std::string& name, const Peer& peer, bool is_exact_on_spheres) {
  bool all = true;
  const double coarse_sphere = error_on_sphere(peer, 1280), fine_sphere = error_on_sphere(peer, 5120);
  if (is_exact_on_spheres) {
    // The normals of Max's weights are exact there, so a side turns by its length over the radius. Some 30 roundings of
    // normals count by the inverse of that turn, at least 0.03 radians, and by the condition of the fit, below 10.
    all &= expect(fine_sphere < 30 * 10 / 0.03 * 0x1p-53, name, "the error on a sphere", fine_sphere);
  } else {
    all &= expect(coarse_sphere > 3 * fine_sphere, name, "the gain of half the sides on a sphere",
                  coarse_sphere / fine_sphere);
  }
  // Errors are of the order of the square of the sides, or of a higher one: half the sides leave a quarter or less.
  // Terms of the next order, by the square of the side, 0.13, over the radius, change that by a few percent.
  const TorusErrors coarse = errors_on_torus(peer, 48), fine = errors_on_torus(peer, 96);
  all &= expect(coarse.mean > 3 * fine.mean, name, "the gain of half the sides on a torus", coarse.mean / fine.mean);
  // A side turns the normal by this angle; the errors of both methods are of second order in it.
  const double turn = 2 * std::numbers::pi / 96;
  all &= expect(fine.mean < turn * turn, name, "the mean error on a torus", fine.mean);
  all &= expect(fine.degrees < 180 / std::numbers::pi * turn, name, "the error of directions on a torus", fine.degrees);
  all &= expect(fine.normals < 180 / std::numbers::pi * turn, name, "the error of normals on a torus", fine.normals);
  return all;
}

}  // namespace

bool peers_are_right() {
  const bool mesh = is_right("mesh", mesh_curvature, true);
  const bool jets = !have_jets() || is_right("jets", jet_curvature, false);
  return mesh && jets;
}

}  // namespace medial_vk::bench
