#include "proximity/body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/format_text.h"
#include "base/host_memory.h"
#include "proximity/placement.h"

namespace medial_vk {
namespace {

Status check(std::span<const Ball> balls, const char* set) {
  if (balls.size() > kMostBodyBalls) {
    return Error{ErrorCode::kUsage, format_text("{} has {} balls, more than {}", set, balls.size(), kMostBodyBalls)};
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto& [centre, radius] = balls[i];
    bool is_good = radius >= 0 && radius <= kLargestCoordinate;
    for (const double x : centre) is_good = is_good && std::fabs(x) + radius <= kLargestCoordinate;
    if (is_good) continue;
    return Error{ErrorCode::kUsage,
                 format_text("ball {} of {} is not finite, has a negative radius or reaches beyond {:g}", i, set,
                             kLargestCoordinate)};
  }
  return {};
}

Status check(const MeshReport& report) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (report.lower[k] >= -kLargestCoordinate && report.upper[k] <= kLargestCoordinate) continue;
    return Error{ErrorCode::kInvalidMesh, format_text("the mesh reaches beyond {:g}", kLargestCoordinate)};
  }
  return {};
}

class Box {
 public:
  void add(const Point& p) {
    lower_ = least(lower_, p);
    upper_ = greatest(upper_, p);
  }
  Point middle() const { return 0.5 * (lower_ + upper_); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point lower_ = {kInfinity, kInfinity, kInfinity}, upper_ = {-kInfinity, -kInfinity, -kInfinity};
};

Point middle_of(const IndexedMesh* mesh, std::span<const Ball> inside, std::span<const Ball> cover) {
  Box box;
  if (mesh) {
    box.add(mesh->prepared().report.lower);
    box.add(mesh->prepared().report.upper);
  }
  for (const std::span<const Ball> balls : {inside, cover}) {
    for (const Ball& ball : balls) box.add(ball.centre);
  }
  return box.middle();
}

Status check_sets(std::span<const Ball> inside, std::span<const Ball> cover) {
  if (Status status = check(inside, "`inside`"); !status) return status;
  return check(cover, "`cover`");
}

std::vector<std::array<Point, 6>> extremes_of(const Mesh& mesh) {
  ConnectedVertices connected;
  for (const auto& [a, b, c] : mesh.triangles) {
    connected.connect(a, b);
    connected.connect(b, c);
  }
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> component_of(mesh.vertices.size(), kNone);
  std::vector<std::array<Point, 6>> extremes;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      const Point& p = mesh.vertices[v];
      std::size_t& component = component_of[connected.root(v)];
      if (component == kNone) {
        component = extremes.size();
        extremes.emplace_back().fill(p);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Point &first = extremes[component][2 * axis], &last = extremes[component][2 * axis + 1];
        if (p[axis] < first[axis]) first = p;
        if (p[axis] > last[axis]) last = p;
      }
    }
  }
  return extremes;
}

template <class Impl>
std::shared_ptr<Impl> impl_of(const IndexedMesh* mesh, std::span<const Ball> inside, std::span<const Ball> cover) {
  auto impl = std::make_shared<Impl>();
  impl->centre = middle_of(mesh, inside, cover);
  impl->inside.assign(inside.begin(), inside.end());
  impl->cover.assign(cover.begin(), cover.end());
  impl->inside_tree = BodyTree::build(inside, impl->centre);
  impl->cover_tree = BodyTree::build(cover, impl->centre);
  impl->large_inside = LargeBalls(impl->inside_tree);
  return impl;
}

}  // namespace

BodySurface::BodySurface(Solid of_mesh, const Point& centre, unsigned threads, LoopWatch& watch)
    : solid(std::move(of_mesh)),
      tree(SurfaceTree::build(solid, centre, threads, watch)),
      extremes(extremes_of(solid.mesh().mesh)) {}

Result<Body> Body::create(std::span<const Ball> inside, std::span<const Ball> cover) {
  if (inside.empty() && cover.empty()) return Error{ErrorCode::kUsage, "a body needs balls `inside` or a `cover`"};
  if (Status status = check_sets(inside, cover); !status) return status.error();
  return catch_out_of_memory("indexing the balls of a body",
                             [&]() -> Result<Body> { return Body(impl_of<Impl>(nullptr, inside, cover)); });
}

Result<Body> Body::create(const IndexedMesh& mesh, std::span<const Ball> inside, std::span<const Ball> cover,
                          const BodyOptions& options, const ProgressCallback& progress, const std::stop_token& stop) {
  if (Status status = check(mesh.prepared().report); !status) return status.error();
  if (Status status = check_sets(inside, cover); !status) return status.error();
  if (!inside.empty() && !mesh.prepared().report.closed) {
    return Error{ErrorCode::kUsage, "balls `inside` a mesh that is not closed: it encloses nothing"};
  }
  return catch_out_of_memory("indexing the triangles of a body", [&]() -> Result<Body> {
    LoopWatch watch(progress, stop);
    try {
      Result<Solid> solid = Solid::build(mesh);
      if (!solid) return solid.error();
      const auto impl = impl_of<Impl>(&mesh, inside, cover);
      impl->surface = std::make_unique<BodySurface>(std::move(solid).value(), impl->centre, options.threads, watch);
      if (!inside.empty() && !cover.empty()) {
        impl->errors = mean_errors(impl->surface->solid, impl->inside_tree, impl->cover_tree, impl->centre,
                                   options.threads, watch);
      }
      return Body(impl);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

std::span<const Ball> Body::inside() const { return impl_->inside; }
std::span<const Ball> Body::cover() const { return impl_->cover; }
bool Body::has_mesh() const { return impl_->surface != nullptr; }

}  // namespace medial_vk
