#include "search/search.h"

#include <algorithm>
#include <cmath>

namespace medial_vk::reference {

using Eigen::Vector3d;
using Eigen::Vector3i;

namespace {

// Lines stay inside a voxel by this share of its side, so that rounding does not move their ends across a face.
constexpr double kHair = 1e-9;
// Levels below the voxel from which points beside a sheet are tested: there cells are not much larger than epsilon.
constexpr int kDirectDepth = 2;
// Levels below the voxel at which cells that meet the boundary are given up if normals are not trusted: a point in them
// has a radius below sqrt(3) / 2^5 of the voxel side.
constexpr int kLevelsAlongBoundary = 5;
// Closer to the boundary than this many rounding errors, directions are dominated by rounding: beside a reflex vertex,
// such as a corner of a box seen from outside, points would seem to have several closest points.
constexpr double kLeastDistance = 8;

}  // namespace

// This distance and that of a reader are both off by at most rounding(): twice that keeps radius <= distance.
double safe_radius(const Tree& tree, double distance) { return std::max(0.0, distance - 2 * tree.rounding()); }

VoxelSearch::VoxelSearch(const Tree& tree, const SpokeCones& cones, const Sides& sides, const Grid& grid,
                         const Thresholds& thresholds, int extra_levels, Watch& watch, Result& result)
    : tree_(tree),
      cones_(cones),
      sides_(sides),
      grid_(grid),
      thresholds_(thresholds),
      extra_levels_(extra_levels),
      watch_(watch),
      result_(result) {}

Outcome VoxelSearch::run(const Vector3i& voxel, Side where, const ContactList& parent, Sphere& sphere) {
  const int finest = grid_.levels - 1;
  voxel_ = voxel;
  lower_ = grid_.lower_corner(voxel, finest) + Vector3d::Constant(kHair * grid_.voxel_size);
  upper_ = lower_ + Vector3d::Constant((1 - 2 * kHair) * grid_.voxel_size);
  undecided_ = {voxel, UndecidedKind::kNearFace, 0};
  return search({grid_.centre(voxel, finest), grid_.voxel_size, where}, 0, parent, sphere);
}

// Contacts -> outside? -> dismissed? -> aimed lines -> points beside a sheet -> parts.
Outcome VoxelSearch::search(const Cell& cell, int depth, const ContactList& parent, Sphere& sphere) {
  LevelCount& count = result_.levels[grid_.levels - 1 + depth];
  if (watch_.stops()) return Outcome::kUndecided;
  ++count.visited;
  const Box box = cube(cell.centre, cell.side);
  // Larger by epsilon, so that the list also holds the nearest points of the pushed balls of the growth test.
  const ContactList list(parent, cell.centre, box.reach() + thresholds_.epsilon);
  ++result_.queries;
  const Closest& nearest = list.nearest_to_centre();
  const Side where = cell.where == Side::kMixed ? sides_.of_ball(cell.centre, box.reach(), nearest) : cell.where;
  if (where == Side::kOutside) return Outcome::kEmpty;
  BoxTest test(tree_, cones_, box, list);
  const double angle = thresholds_.angle_at(nearest.distance + box.reach());
  if (test.dismisses(angle)) return Outcome::kEmpty;
  ++count.kept;
  count.contacts += list.contacts().size();
  const bool found =
      aim(cell, test, list, angle, where, sphere) || (depth >= kDirectDepth && stand_beside(cell, list, where, sphere));
  if (found) {
    ++count.found;
    return Outcome::kFound;
  }
  // A cell that meets the boundary where normals are unreliable may hold medial points of either side, so it is
  // subdivided only to kLevelsAlongBoundary.
  const auto distrusted = [](const Contact& contact) { return !contact.trusted; };
  const bool hopeless =
      nearest.distance <= box.reach() && std::any_of(test.contacts().begin(), test.contacts().end(), distrusted);
  if (depth < (hopeless ? std::min(kLevelsAlongBoundary, extra_levels_) : extra_levels_)) {
    return search_parts(cell, where, depth, list, sphere);
  }
  note_undecided(test, list, angle);
  return Outcome::kUndecided;
}

void VoxelSearch::note_undecided(BoxTest& test, const ContactList& list, double angle) {
  const Box voxel = {(lower_ + upper_) / 2, Vector3d::Constant(grid_.voxel_size / 2)};
  undecided_.kind = std::max(undecided_.kind, kind_of(tree_, cones_, thresholds_, test, list, voxel));
  undecided_.width = std::max(undecided_.width, test.width(angle));
}

Outcome VoxelSearch::search_parts(const Cell& cell, Side where, int depth, const ContactList& list, Sphere& sphere) {
  Outcome all = Outcome::kEmpty;
  for (int k = 0; k < 8; ++k) {
    const Vector3d offset((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, (k >> 2) - 0.5);
    const Outcome part =
        search({cell.centre + offset * (cell.side / 2), cell.side / 2, where}, depth + 1, list, sphere);
    if (part == Outcome::kFound) return part;
    if (part == Outcome::kUndecided) all = part;
  }
  return all;
}

bool VoxelSearch::aim(const Cell& cell, const BoxTest& test, const ContactList& list, double angle, Side where,
                      Sphere& sphere) {
  for (const Line& line :
       aimed_lines(tree_, test.box(), thresholds_.epsilon, test.nearest(), test.contacts(), test.pairs())) {
    const std::optional<Segment> segment = clip(cell, line);
    if (segment && try_segment(*segment, list, angle, where, sphere)) return true;
  }
  return false;
}

// Points beside a sheet (docs/theory.md): the centres of the parts of the cell, without narrowing.
bool VoxelSearch::stand_beside(const Cell& cell, const ContactList& list, Side where, Sphere& sphere) {
  for (int k = 0; k < 8; ++k) {
    const Vector3d offset((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, (k >> 2) - 0.5);
    const End here = look(cell.centre + offset * (cell.side / 2), list);
    const std::optional<End> there = second_contact(here, list);
    if (there && accept(here, *there, list, where, sphere)) return true;
  }
  return false;
}

/// Of the contacts that satisfy the growth test, the one whose direction differs most. Only a foot in the interior of a
/// face is certainly the end of a spoke, so that the angle is that of a sheet.
std::optional<VoxelSearch::End> VoxelSearch::second_contact(const End& here, const ContactList& list) const {
  const Vector3d pushed = here.point - thresholds_.epsilon * here.gradient;
  const double limit = here.nearest.distance + thresholds_.epsilon - 16 * tree_.rounding();
  std::optional<End> best;
  for (const Contact& contact : list.contacts()) {
    if ((tree_.closest_on(contact.triangle, pushed).point - pushed).norm() >= limit) continue;
    const TrianglePoint at = tree_.closest_on(contact.triangle, here.point);
    if (!contact.trusted || at.feature != Feature::kFace) continue;
    const Closest other = {at.point, (at.point - here.point).norm(), contact.triangle, at.feature};
    const Vector3d direction = direction_to(here.point, other);
    if (!best || direction.dot(here.gradient) < best->gradient.dot(here.gradient))
      best = {here.point, other, direction};
  }
  return best;
}

/// The part of a line that lies in the voxel and in the cell's ball, where its list holds.
std::optional<VoxelSearch::Segment> VoxelSearch::clip(const Cell& cell, const Line& line) const {
  const Vector3d point = cell.centre + line.base, &direction = line.direction;
  const double along = line.base.dot(direction), radius = circumradius(cell.side);
  const double squared = along * along - line.base.squaredNorm() + radius * radius;
  if (squared <= 0) return std::nullopt;
  double from = -along - std::sqrt(squared), to = -along + std::sqrt(squared);
  for (int a = 0; a < 3; ++a) {
    if (std::abs(direction[a]) < 1e-14) {
      if (point[a] < lower_[a] || point[a] > upper_[a]) return std::nullopt;
      continue;
    }
    const double s = (lower_[a] - point[a]) / direction[a], t = (upper_[a] - point[a]) / direction[a];
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
  }
  if (to <= from) return std::nullopt;
  return Segment{point + from * direction, point + to * direction};
}

VoxelSearch::End VoxelSearch::look(const Vector3d& p, const ContactList& list) {
  ++result_.queries;
  const Closest nearest = list.closest(p);
  return {p, nearest, direction_to(p, nearest)};
}

// Bisects towards the larger turn of the gradient until the ends are within h of each other. The gradient also flips
// where the segment crosses the boundary, where the distances at the ends of a half add up to at most its length: such
// a half is taken only if the other one does not turn enough.
//
// How small h must be for the growth test to hold: let the gradients at p and q turn by 2 phi, |p - q| <= h, let Q be
// nearest to q, and push p to c = p - epsilon g_p. Then c - Q = (p - q) - (epsilon g_p + D_q g_q), and
//   |epsilon g_p + D_q g_q|^2 = (D_q + epsilon)^2 - 2 epsilon D_q (1 - cos 2 phi),
// so with sqrt(a^2 - b) <= a - b / 2a and D_q <= D_p + h
//   |c - Q| <= 2 h + D_p + epsilon - 2 epsilon sin^2 phi D_q / (D_q + epsilon):
// below D_p + epsilon, the radius of the pushed ball, if h < epsilon sin^2 phi D_q / (D_q + epsilon). Half of that is
// used, which leaves a margin of the same size. phi is at least theta and at most pi/2, where sin grows.
bool VoxelSearch::try_segment(const Segment& segment, const ContactList& list, double angle, Side where,
                              Sphere& sphere) {
  constexpr int kMostHalvings = 64;  // h shrinks with D on the boundary
  End p = look(segment.p, list), q = look(segment.q, list);
  const double least_turn = std::cos(2 * angle);
  if (p.gradient.dot(q.gradient) > least_turn) return false;
  const double sine = std::sin(angle);
  const auto rank = [&](const End& a, const End& b) {
    const double turn = a.gradient.dot(b.gradient);
    const bool may_cross = a.nearest.distance + b.nearest.distance <= (a.point - b.point).norm() * (1 + 1e-9);
    return turn + (turn > least_turn ? 4 : may_cross ? 2 : 0);
  };
  for (int i = 0; i < kMostHalvings; ++i) {
    const double distance = std::min(p.nearest.distance, q.nearest.distance);
    const double h = 0.5 * thresholds_.epsilon * sine * sine * distance / (distance + thresholds_.epsilon);
    if ((p.point - q.point).norm() <= h) break;
    End m = look((p.point + q.point) / 2, list);
    (rank(p, m) < rank(m, q) ? q : p) = m;
  }
  return accept(p, q, list, where, sphere) || accept(q, p, list, where, sphere);
}

// An end is accepted if it is salient, in the voxel, passes the growth test of Lemma 2.3 and lies inside; cheap tests
// come first.
bool VoxelSearch::accept(const End& here, const End& there, const ContactList& list, Side where, Sphere& sphere) {
  const double angle = half_angle(here.gradient, there.gradient);
  const double distance = here.nearest.distance, radius = safe_radius(tree_, distance);
  if (distance < kLeastDistance * tree_.rounding() || angle < thresholds_.angle_at(distance)) return false;
  if ((here.point - there.point).norm() > thresholds_.epsilon || grid_.voxel_of(here.point) != voxel_) return false;
  const auto distance_at = [&](const Vector3d& p) { return look(p, list).nearest.distance; };
  if (!grows_into_boundary(tree_, here.point, distance, here.gradient, thresholds_.epsilon, distance_at)) return false;
  if (where != Side::kInside && !sides_.inside(here.point, here.nearest)) return false;
  sphere = {here.point, radius, here.gradient, there.gradient, angle, 0, voxel_};
  return true;
}

}  // namespace medial_vk::reference
