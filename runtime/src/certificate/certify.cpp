#include "medial_vk/certify.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/voxel_order.h"
#include "bvh/nearby_triangles.h"
#include "certificate/near_triangles.h"
#include "solid/solid.h"

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

// Half the angle between two vectors, accurate for all angles (Kahan): of the spokes as written to the output.
double half_angle(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  const Point x = widen(a), y = widen(b);
  const Point u = (1 / norm(x)) * x, v = (1 / norm(y)) * y;
  return std::atan2(norm(u - v), norm(u + v));
}

/// The state of a thread: the leaves of the tree near the current spheres, and the triangles near one of them.
struct Surroundings {
  Region region;
  std::vector<std::uint32_t> nearby;
  std::vector<float> bounds;
};

class Certifier {
 public:
  Certifier(const IndexedMesh& mesh, const ExtractionOptions& options, const VoxelGrid& grid)
      : bvh_(mesh.bvh()),
        triangles_(bvh_, mesh.region_lower(), mesh.region_upper()),
        options_(options),
        grid_(grid),
        longest_(mesh.longest_side()),
        epsilon_(options.epsilon * grid.voxel_size),
        rounding_(distance_rounding(mesh)) {}

  /// Gathers the tree's leaves near these spheres, for certify() of each.
  void surround(const std::vector<MedialSphere>& spheres, std::span<const std::uint32_t> group, Surroundings& s) const {
    const Point& centre = spheres[group[group.size() / 2]].centre;
    double radius = 0;
    for (const std::uint32_t i : group)
      radius = std::max(radius, norm(spheres[i].centre - centre) + expected_radius(spheres[i]) + 2 * epsilon_);
    triangles_.surround(centre, radius * (1 + 1e-9), s.region);
  }

  /// As certify() for the sphere or, if it fails, for one beside it on the same sheet: double can distinguish contacts
  /// of three sheets that nearly tie in float.
  bool certify_or_mend(MedialSphere& s, Surroundings& around) const {
    const MedialSphere as_found = s;
    if (certify(s, around)) return true;
    for (const MedialSphere& mended : narrowed(as_found)) {
      s = mended;
      if (certify(s, around)) return true;
    }
    return false;
  }

  /// Recomputes the sphere's numbers exactly; false if it fails a condition of the certificate.
  bool certify(MedialSphere& s, Surroundings& around) const {
    if (!in_its_voxel(s)) return false;
    // All queries below lie within the ball, grown by 2 epsilon, if the device's radius is correct.
    const double expected = expected_radius(s), reach = expected + 2 * epsilon_;
    std::vector<std::uint32_t>& nearby = around.nearby;
    const std::size_t inner = triangles_.gather(around.region, s.centre, reach, expected, nearby);
    BvhHit nearest = triangles_.closest_of(s.centre, std::span(nearby).first(inner), around.bounds);
    if (!(nearest.squared_distance <= expected * expected)) {
      nearest = bvh_.closest(s.centre);
      gather_within(bvh_, s.centre, std::sqrt(nearest.squared_distance) + 2 * epsilon_, nearby);
    }
    const double distance = std::sqrt(nearest.squared_distance);
    if (distance <= 2 * rounding_) return false;
    s.radius = distance - rounding_;
    const Point toward = (1 / distance) * (nearest.point - s.centre);
    const Point grown_centre = s.centre - epsilon_ * toward;
    set_spokes(s, unit_float(toward));
    // Lemma 2.3: pushed away from its contact, the ball would keep its distance from it, D + epsilon. Triangles not
    // gathered are no nearer than that. The tip is tested first, as triangles near it usually lie within the grown
    // ball.
    const bool near = tip_is_near(s, nearby);
    if (!any_within(grown_centre, distance + epsilon_ - 4 * rounding_, nearby)) return false;
    if (near && is_salient(s)) return set_angle(s);
    // Where many contacts tie (the centre of a sphere), the exact nearest one may lie between the two of the device.
    s.spoke_b = unit_float(closest_of(bvh_, grown_centre, nearby).point - grown_centre);
    return tip_is_near(s, nearby) && is_salient(s) && set_angle(s);
  }

 private:
  // An upper bound, if the device is correct.
  double expected_radius(const MedialSphere& s) const { return s.radius + 1e-5 * longest_; }

  struct End {
    Point point, toward;
    double distance;
  };

  End evaluate(const Point& p) const {
    const BvhHit nearest = bvh_.closest(p);
    const double distance = std::sqrt(nearest.squared_distance);
    return {p, (1 / std::max(distance, rounding_)) * (nearest.point - p), distance};
  }

  // The segment through the centre along the sheet's normal (equation 2.11), epsilon to both sides, bisected towards
  // the larger turn until the growth test must hold (docs/theory.md, "How far to narrow"): a sphere at each end. None
  // where the boundary is within twice epsilon, so that the ends lie in the solid if the centre does.
  std::vector<MedialSphere> narrowed(const MedialSphere& s) const {
    const Point across = widen(s.spoke_b) - widen(s.spoke_a);
    if (norm(across) < 1e-3 || evaluate(s.centre).distance <= 2 * epsilon_) return {};
    const Point step = (epsilon_ / norm(across)) * across;
    End p = evaluate(s.centre - step), q = evaluate(s.centre + step);
    const double sine = std::sin(double{s.object_angle});
    for (int i = 0; i < 64; ++i) {
      const double distance = std::min(p.distance, q.distance);
      if (norm(p.point - q.point) <= 0.5 * epsilon_ * sine * sine * distance / (distance + epsilon_)) break;
      const End middle = evaluate(0.5 * (p.point + q.point));
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

  // Spoke b is the direction that the search found on the other side of the sheet. Where the two contacts tie within
  // the rounding of the device, the other one may be nearest in exact arithmetic: then the device's spoke a is spoke b.
  void set_spokes(MedialSphere& s, const std::array<float, 3>& a) const {
    const bool swapped = dot(widen(a), widen(s.spoke_b)) > dot(widen(a), widen(s.spoke_a));
    const std::array<float, 3> b = swapped ? s.spoke_a : s.spoke_b;
    s.spoke_a = a;
    s.spoke_b = unit_float(widen(b));
  }

  // True if one of the nearby triangles is closer to p than that. It is moved to the front, as the next query often
  // concerns it too.
  bool any_within(const Point& p, double radius, std::vector<std::uint32_t>& nearby) const {
    const std::size_t found = find_within(bvh_, p, radius, nearby);
    if (found == nearby.size()) return false;
    std::swap(nearby.front(), nearby[found]);
    return true;
  }

  // Lemma 2.4: the tip of spoke b is within 2 epsilon of the boundary.
  bool tip_is_near(const MedialSphere& s, std::vector<std::uint32_t>& nearby) const {
    return any_within(s.centre + s.radius * widen(s.spoke_b), 2 * epsilon_ * (1 - 1e-6), nearby);
  }

  bool is_salient(const MedialSphere& s) const {
    const double angle = half_angle(s.spoke_a, s.spoke_b);
    return angle >= options_.object_angle || (options_.radius > 0 && s.radius >= options_.radius * longest_);
  }

  const Bvh& bvh_;
  NearTriangles triangles_;
  const ExtractionOptions& options_;
  const VoxelGrid& grid_;
  double longest_, epsilon_, rounding_;
};

/// Groups of spheres in cubes of four voxels along a side: neighbours, whose queries test the same leaves.
class NeighbourGroups {
 public:
  explicit NeighbourGroups(const std::vector<MedialSphere>& spheres) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    keys.reserve(spheres.size());
    for (const MedialSphere& s : spheres) keys.emplace_back(key_of(s), static_cast<std::uint32_t>(keys.size()));
    std::ranges::sort(keys);
    order_.reserve(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i == 0 || keys[i].first != keys[i - 1].first) begins_.push_back(i);
      order_.push_back(keys[i].second);
    }
    begins_.push_back(keys.size());
  }

  std::size_t size() const { return begins_.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(order_).subspan(begins_[group], begins_[group + 1] - begins_[group]);
  }

 private:
  static std::uint64_t key_of(const MedialSphere& s) {
    std::uint64_t key = 0;
    for (const std::uint32_t coordinate : s.voxel) key = key << 21 | coordinate >> 2;
    return key;
  }

  std::vector<std::uint32_t> order_;  // indices of spheres, group by group
  std::vector<std::size_t> begins_;   // of groups in order_, and its end
};

/// The chunk of a thread: large enough that threads seldom contend, small enough that none waits long for another at
/// the end.
constexpr std::size_t kGroupsAtOnce = 8;

/// 1 for each sphere that is the first of its voxel. Precondition: voxel order.
std::vector<std::uint8_t> first_of_voxels(const std::vector<MedialSphere>& spheres) {
  std::vector<std::uint8_t> is_first(spheres.size(), 1);
  for (std::size_t i = 1; i < spheres.size(); ++i) is_first[i] = spheres[i].voxel != spheres[i - 1].voxel ? 1 : 0;
  return is_first;
}

/// The voxel of a dropped sphere has neither a point nor a proof; the reason was not tested. D changes by no more than
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

Result<CertificateReport> certify_spheres(const IndexedMesh& mesh, const ExtractionOptions& options,
                                          Extraction& extraction) try {
  if (extraction.side != mesh.side()) {
    return Error{ErrorCode::kUsage, "the spheres are those of the other side of the mesh"};
  }
  std::vector<MedialSphere>& spheres = extraction.spheres;
  const Certifier certifier(mesh, options, extraction.grid);
  std::vector<std::uint8_t> passed = first_of_voxels(spheres);
  const std::size_t count = thread_count(options.threads);
  const NeighbourGroups groups(spheres);
  std::atomic<std::size_t> next = 0;
  parallel_for(count, 1, options.threads, [&](std::size_t) {
    Surroundings around;
    for (std::size_t first = next.fetch_add(kGroupsAtOnce); first < groups.size();
         first = next.fetch_add(kGroupsAtOnce)) {
      for (std::size_t g = first; g < std::min(first + kGroupsAtOnce, groups.size()); ++g) {
        certifier.surround(spheres, groups[g], around);
        for (const std::uint32_t i : groups[g])
          passed[i] = passed[i] != 0 && certifier.certify_or_mend(spheres[i], around) ? 1 : 0;
      }
    }
  });

  if (options.mode == Mode::kCertified) list_dropped(passed, extraction);
  CertificateReport report;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    if (passed[i] != 0) spheres[report.passed++] = spheres[i];
  report.rejected = spheres.size() - report.passed;
  spheres.resize(report.passed);
  extraction.measurements.counters.found -= report.rejected;
  extraction.measurements.counters.undecided += report.rejected;
  return report;
} catch (const std::bad_alloc&) {
  return out_of_memory("certifying medial spheres", "try a lower `resolution`");
}

}  // namespace medial_vk
