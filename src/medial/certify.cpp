#include "medial/certify.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include "mesh/parallel_for.h"
#include "mesh/solid.h"

namespace medial_vk {
namespace {

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Point& a) { return std::sqrt(dot(a, a)); }

Point widen(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

std::array<float, 3> unit_float(const Point& v) {
  const double length = norm(v);
  return {static_cast<float>(v[0] / length), static_cast<float>(v[1] / length), static_cast<float>(v[2] / length)};
}

// Half the angle between two vectors, accurate for all angles (Kahan): of the spokes as they are written.
double half_angle(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  const Point x = widen(a), y = widen(b);
  const Point u = (1 / norm(x)) * x, v = (1 / norm(y)) * y;
  return std::atan2(norm(u - v), norm(u + v));
}

class Certifier {
 public:
  Certifier(const Bvh& bvh, const ExtractionParameters& parameters, double longest_side, const VoxelGrid& grid)
      : bvh_(bvh),
        parameters_(parameters),
        grid_(grid),
        longest_(longest_side),
        epsilon_(parameters.epsilon * grid.voxel_size),
        rounding_(distance_rounding(bvh)) {}

  /// The same for the sphere, or, if it fails, for one beside it on the same sheet: what float could not tell apart
  /// (contacts of three sheets that nearly tie) double can.
  bool certify_or_mend(MedialSphere& s, std::vector<std::uint32_t>& nearby) const {
    const MedialSphere as_found = s;
    if (certify(s, nearby)) return true;
    for (const MedialSphere& mended : narrowed(as_found)) {
      s = mended;
      if (certify(s, nearby)) return true;
    }
    return false;
  }

  /// Makes the sphere's numbers exact, with `nearby` as scratch memory; false if it fails a condition of the
  /// certificate.
  bool certify(MedialSphere& s, std::vector<std::uint32_t>& nearby) const {
    if (!in_its_voxel(s)) return false;
    // What is asked below lies within the ball, grown by 2 epsilon, if the device's radius is right.
    const double expected = s.radius + 1e-5 * longest_, reach = expected + 2 * epsilon_;
    bvh_.gather_within(s.centre, reach, nearby);
    BvhHit nearest = bvh_.closest_of(s.centre, nearby);
    if (!(nearest.squared_distance <= expected * expected)) {
      nearest = bvh_.closest(s.centre);
      bvh_.gather_within(s.centre, std::sqrt(nearest.squared_distance) + 2 * epsilon_, nearby);
    }
    const double distance = std::sqrt(nearest.squared_distance);
    if (distance <= 2 * rounding_) return false;
    s.radius = distance - rounding_;
    const Point toward = (1 / distance) * (nearest.point - s.centre);
    const Point grown_centre = s.centre - epsilon_ * toward;
    const BvhHit grown = bvh_.closest_of(grown_centre, nearby);
    // Lemma 2.3: pushed away from its contact, the ball would keep its distance from it, D + epsilon. What is not near
    // is no nearer than that.
    if (std::sqrt(grown.squared_distance) >= distance + epsilon_ - 4 * rounding_) return false;
    const std::array<float, 3> a = unit_float(toward), beyond = unit_float(grown.point - grown_centre);
    set_spokes(s, a);
    if (tip_is_near(s, nearby) && is_salient(s)) return set_angle(s);
    // Where many contacts tie (the centre of a sphere), the exact nearest one may lie between the two of the device.
    s.spoke_b = beyond;
    return tip_is_near(s, nearby) && is_salient(s) && set_angle(s);
  }

 private:
  struct End {
    Point point, toward;
    double distance;
  };

  End look(const Point& p) const {
    const BvhHit nearest = bvh_.closest(p);
    const double distance = std::sqrt(nearest.squared_distance);
    return {p, (1 / std::max(distance, rounding_)) * (nearest.point - p), distance};
  }

  // The segment through the centre along the sheet's normal (equation 2.11), epsilon to both sides, bisected towards
  // the larger turn until the growth test must hold (docs/theory.md, "How far to narrow"): a sphere at each end. None
  // where the boundary is within twice epsilon, so that the ends lie in the solid if the centre does.
  std::vector<MedialSphere> narrowed(const MedialSphere& s) const {
    const Point across = widen(s.spoke_b) - widen(s.spoke_a);
    if (norm(across) < 1e-3 || look(s.centre).distance <= 2 * epsilon_) return {};
    const Point step = (epsilon_ / norm(across)) * across;
    End p = look(s.centre - step), q = look(s.centre + step);
    const double sine = std::sin(double{s.object_angle});
    for (int i = 0; i < 64; ++i) {
      const double distance = std::min(p.distance, q.distance);
      if (norm(p.point - q.point) <= 0.5 * epsilon_ * sine * sine * distance / (distance + epsilon_)) break;
      const End middle = look(0.5 * (p.point + q.point));
      (dot(p.toward, middle.toward) < dot(middle.toward, q.toward) ? q : p) = middle;
    }
    MedialSphere at_p = s, at_q = s;
    at_p.centre = p.point;
    at_q.centre = q.point;
    at_p.spoke_a = at_q.spoke_b = unit_float(p.toward);
    at_p.spoke_b = at_q.spoke_a = unit_float(q.toward);
    return {at_p, at_q};
  }

  static bool set_angle(MedialSphere& s) {
    s.object_angle = static_cast<float>(half_angle(s.spoke_a, s.spoke_b));
    return true;
  }

  bool in_its_voxel(const MedialSphere& s) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double cell = std::floor((s.centre[axis] - grid_.origin[axis]) / grid_.voxel_size);
      if (cell != static_cast<double>(s.voxel[axis])) return false;
    }
    return true;
  }

  // Spoke b is the direction that the search saw on the other side of the sheet. Where the two contacts tie within the
  // rounding of the device, exact arithmetic may call the other one nearest: then the device's spoke a is spoke b.
  void set_spokes(MedialSphere& s, const std::array<float, 3>& a) const {
    const bool swapped = dot(widen(a), widen(s.spoke_b)) > dot(widen(a), widen(s.spoke_a));
    const std::array<float, 3> b = swapped ? s.spoke_a : s.spoke_b;
    s.spoke_a = a;
    s.spoke_b = unit_float(widen(b));
  }

  // Lemma 2.4: the tip of spoke b is within 2 epsilon of the boundary.
  bool tip_is_near(const MedialSphere& s, const std::vector<std::uint32_t>& nearby) const {
    const BvhHit nearest = bvh_.closest_of(s.centre + s.radius * widen(s.spoke_b), nearby);
    return std::sqrt(nearest.squared_distance) < 2 * epsilon_ * (1 - 1e-6);
  }

  bool is_salient(const MedialSphere& s) const {
    const double angle = half_angle(s.spoke_a, s.spoke_b);
    return angle >= parameters_.object_angle || (parameters_.radius > 0 && s.radius >= parameters_.radius * longest_);
  }

  const Bvh& bvh_;
  const ExtractionParameters& parameters_;
  const VoxelGrid& grid_;
  double longest_, epsilon_, rounding_;
};

/// The voxel of a sphere that is dropped has neither a point nor a proof; why, nobody asked. D changes by no more than
/// the point moves, so no ball centred in the voxel has a larger radius than the dropped one by more than the diagonal.
void list_dropped(const std::vector<std::uint8_t>& passed, Extraction& extraction) {
  std::vector<UndecidedVoxel>& undecided = extraction.undecided;
  const std::size_t known = undecided.size();
  const double diagonal = std::sqrt(3.0) * extraction.grid.voxel_size;
  for (std::size_t i = 0; i < passed.size(); ++i) {
    const MedialSphere& dropped = extraction.spheres[i];
    const auto width = static_cast<float>(2 * (dropped.radius + diagonal));
    if (passed[i] == 0) undecided.push_back({dropped.voxel, UndecidedKind::kOther, width});
  }
  std::inplace_merge(undecided.begin(), undecided.begin() + static_cast<std::ptrdiff_t>(known), undecided.end(),
                     [](const auto& a, const auto& b) { return is_earlier_voxel(a.voxel, b.voxel); });
}

}  // namespace

CertifyReport certify_spheres(const Bvh& bvh, const ExtractionParameters& parameters, double longest_side,
                              Extraction& extraction, unsigned threads) {
  std::vector<MedialSphere>& spheres = extraction.spheres;
  const Certifier certifier(bvh, parameters, longest_side, extraction.grid);
  std::vector<std::uint8_t> passed(spheres.size());
  const std::size_t count = threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
  const auto certify_part = [&](std::size_t part) {
    std::vector<std::uint32_t> nearby;
    for (std::size_t i = part * spheres.size() / count; i < (part + 1) * spheres.size() / count; ++i)
      passed[i] = certifier.certify_or_mend(spheres[i], nearby) ? 1 : 0;
  };
  parallel_for(count, 1, certify_part);

  CertifyReport report;
  std::vector<MedialSphere> kept;
  kept.reserve(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i)
    if (passed[i]) kept.push_back(spheres[i]);
  if (parameters.mode == Mode::kCertified) list_dropped(passed, extraction);
  report.passed = kept.size();
  report.rejected = spheres.size() - kept.size();
  spheres = std::move(kept);
  extraction.counters.found -= report.rejected;
  extraction.counters.undecided += report.rejected;
  return report;
}

}  // namespace medial_vk
