#include "sphere_fits/quality/sphere_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "sphere_fits/quality/branch_and_bound.h"

namespace medial_vk {
namespace {

constexpr double kUnit = 0x1p-53;
/// Greatest number of halvings of a triangle: 2^-40 of its size is below the accuracy of written balls.
constexpr int kDepth = 40;
/// Greatest number of parts of a triangle; one for which they do not suffice is undecided.
constexpr std::size_t kMostParts = 200'000;

enum class Cover : std::uint8_t { kCovered, kUncovered, kUndecided };

/// The test whether one triangle is covered.
class TriangleCover {
 public:
  TriangleCover(const NearestBallTree& tree, double magnitude)
      : tree_(tree), moved_(kDepth * 1.7320508075688775 * kUnit * magnitude) {}

  Cover run(const std::array<Point, 3>& triangle, Point& where) {
    stack_.assign(1, {triangle, 0, 0});
    lists_.clear();
    std::vector<std::uint32_t> found;
    const Point middle = middle_of(triangle);
    tree_.gather(middle, reach(triangle, middle), found);
    lists_.push_back(found);
    std::size_t parts = 0;
    while (!stack_.empty()) {
      const Part part = stack_.back();
      stack_.pop_back();
      const Cover cover = test(part);
      if (cover == Cover::kCovered) continue;
      where = middle_of(part.corner);
      if (cover == Cover::kUncovered) return cover;
      if (part.depth == kDepth || ++parts > kMostParts) return Cover::kUndecided;
    }
    return Cover::kCovered;
  }

 private:
  struct Part {
    std::array<Point, 3> corner;
    int depth;
    std::size_t list;  // balls that may meet it
  };

  static Point middle_of(const std::array<Point, 3>& c) { return (1.0 / 3) * (c[0] + (c[1] + c[2])); }
  static double reach(const std::array<Point, 3>& c, const Point& from) {
    return std::max({length(c[0] - from), length(c[1] - from), length(c[2] - from)});
  }

  /// A ball is convex: a part is in it if its corners are. Corners of parts are rounded, up to once per halving, by
  /// half a unit in the last place of each coordinate: the parts are exact parts of the triangle, moved by at most
  /// moved_. Lengths have relative errors of at most 4u.
  bool holds(const Ball& ball, const Part& part) const {
    const double most = ball.radius * (1 - 8 * kUnit) - moved_;
    return reach(part.corner, ball.centre) <= most;
  }

  /// kUndecided: parts of it are on the stack, unless it is too small.
  Cover test(const Part& part) {
    const Point middle = middle_of(part.corner);
    const double around = reach(part.corner, middle);
    std::vector<std::uint32_t> near;
    bool is_covered = false;
    lists_.resize(part.list + 1);  // drops those of finished parts
    for (const std::uint32_t i : lists_[part.list]) {
      const Ball& ball = tree_.balls()[i];
      const double distance = length(middle - ball.centre) - ball.radius;
      if (distance > around) continue;
      if (distance <= 0) is_covered = true;
      if (distance <= 0 && holds(ball, part)) return Cover::kCovered;
      near.push_back(i);
    }
    if (!is_covered) return Cover::kUncovered;
    if (part.depth == kDepth) return Cover::kUndecided;
    lists_.push_back(std::move(near));
    const std::size_t list = lists_.size() - 1;
    const auto& [a, b, c] = part.corner;
    const Point ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    const int depth = part.depth + 1;
    stack_.push_back({{a, ab, ca}, depth, list});
    stack_.push_back({{ab, b, bc}, depth, list});
    stack_.push_back({{ca, bc, c}, depth, list});
    stack_.push_back({{ab, bc, ca}, depth, list});
    return Cover::kUndecided;
  }

  const NearestBallTree& tree_;
  double moved_;
  std::vector<Part> stack_;
  std::vector<std::vector<std::uint32_t>> lists_;  // of the parts on the stack
};

double magnitude_of(const MeshReport& report) {
  double magnitude = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    magnitude = std::max({magnitude, std::fabs(report.lower[axis]), std::fabs(report.upper[axis])});
  }
  return magnitude;
}

void test_surface(const Solid& solid, const NearestBallTree& tree, const Threads& threads, CoverProof& proof) {
  const Mesh& mesh = solid.mesh().mesh;
  const std::size_t count = mesh.triangles.size();
  const double magnitude = magnitude_of(solid.mesh().report);
  std::vector<Cover> covers(count);
  std::vector<Point> failures(count);
  constexpr std::size_t kTrianglesAtOnce = 32;
  for_all((count + kTrianglesAtOnce - 1) / kTrianglesAtOnce, 1, threads, [&](std::size_t block) {
    TriangleCover cover(tree, magnitude);
    for (std::size_t t = block * kTrianglesAtOnce; t < std::min(count, (block + 1) * kTrianglesAtOnce); ++t) {
      const Triangle& corners = mesh.triangles[t];
      threads.check();
      covers[t] =
          cover.run({mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]}, failures[t]);
    }
  });
  proof.triangles = count;
  for (std::size_t t = 0; t < count; ++t) {
    if (covers[t] == Cover::kCovered) continue;
    if (proof.uncovered + proof.undecided == 0) proof.first_uncovered = failures[t];
    ++(covers[t] == Cover::kUncovered ? proof.uncovered : proof.undecided);
  }
}

void test_vertices(const Solid& solid, const Envelope& envelope, const Threads& threads, CoverProof& proof) {
  const std::vector<EnvelopeVertex>& vertices = envelope.vertices();
  std::vector<std::uint8_t> is_inside(vertices.size());
  for_all(vertices.size(), 64, threads, [&](std::size_t i) {
    const Point& at = vertices[i].at;
    const double error = envelope.error_of(vertices[i]) + 2 * solid.rounding();
    is_inside[i] = solid.contains(at) || !std::isfinite(error) || solid.bvh().any_within(at, error);
  });
  proof.vertices = vertices.size();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (is_inside[i] != 0 && proof.inside++ == 0) proof.first_inside = vertices[i].at;
  }
}

}  // namespace

InsideProof prove_inside(const Solid& solid, std::span<const Ball> balls, const Threads& threads) {
  std::vector<double> excess(balls.size());
  for_all(balls.size(), 16, threads, [&](std::size_t i) {
    const Ball& ball = balls[i];
    const double room = solid.distance(ball.centre) - solid.rounding();
    // A radius that is not a number is a failure, too.
    excess[i] =
        ball.radius >= 0 && solid.contains(ball.centre) ? ball.radius - room : std::numeric_limits<double>::infinity();
  });
  InsideProof proof;
  proof.tested = balls.size();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    proof.greatest_excess = i == 0 ? excess[i] : std::max(proof.greatest_excess, excess[i]);
    if (!(excess[i] <= 0) && proof.failed++ == 0) proof.first_failure = static_cast<std::uint32_t>(i);
  }
  return proof;
}

Result<CoverProof> prove_cover(const Solid& solid, const Envelope& envelope, const Threads& threads) {
  try {
    CoverProof proof;
    proof.closed = solid.mesh().report.closed;
    test_surface(solid, envelope.tree(), threads, proof);
    test_vertices(solid, envelope, threads, proof);
    return proof;
  } catch (const Stopped&) {
    return Error{ErrorCode::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return out_of_memory("proving that the balls cover the solid");
  }
}

Result<CoverProof> prove_cover(const Solid& solid, std::span<const Ball> balls, const Threads& threads) {
  Result<Envelope> envelope = Envelope::build(balls, threads.count);
  if (!envelope) return envelope.error();
  return prove_cover(solid, envelope.value(), threads);
}

}  // namespace medial_vk
