#include "search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace medial_vk::reference {

using Eigen::Vector3d;
using Eigen::Vector3i;

namespace {

// Lines stay this share of a voxel inside it, so that rounding does not carry their ends across a face.
constexpr double kHair = 1e-9;
constexpr int kMostAims = 3;

}  // namespace

// Both this distance and the one a reader computes are off by at most rounding(): two of them keep radius <= distance.
double safe_radius(const Tree& tree, double distance) { return std::max(0.0, distance - 2 * tree.rounding()); }

VoxelSearch::VoxelSearch(const Tree& tree, const Sides& sides, const Grid& grid, const Thresholds& thresholds,
                         int extra_levels, Result& result, const SpokeCones& cones)
    : cones_(cones), tree_(tree), sides_(sides), grid_(grid), thresholds_(thresholds), extra_levels_(extra_levels), result_(result) {}

Outcome VoxelSearch::run(const Vector3i& voxel, Side where, const ContactList& parent, Sphere& sphere) {
  const int finest = grid_.levels - 1;
  voxel_ = voxel;
  lower_ = grid_.lower_corner(voxel, finest) + Vector3d::Constant(kHair * grid_.voxel_size);
  upper_ = lower_ + Vector3d::Constant((1 - 2 * kHair) * grid_.voxel_size);
  notes_.clear();
  const Outcome o = search({grid_.centre(voxel, finest), grid_.voxel_size, where}, 0, parent, sphere);
  if (o == Outcome::kUndecided) std::fputs(notes_.c_str(), stderr);
  return o;
}

// Contacts -> outside? -> dismissed? -> aimed lines -> parts.
Outcome VoxelSearch::search(const Cell& cell, int depth, const ContactList& parent, Sphere& sphere) {
  LevelCount& count = result_.levels[grid_.levels - 1 + depth];
  ++count.visited;
  const double reach = circumradius(cell.side) * (1 + 1e-9);
  // Epsilon more, so that the pushed balls of the growth test find their nearest point in the list too.
  const ContactList list(parent, cell.centre, reach + thresholds_.epsilon);
  ++result_.queries;
  const Closest& nearest = list.nearest_to_centre();
  const Side where = cell.where == Side::kMixed ? sides_.of_ball(cell.centre, reach, nearest) : cell.where;
  if (where == Side::kOutside) return Outcome::kEmpty;
  static const int mode = std::getenv("M") ? std::atoi(std::getenv("M")) : 0;
  const std::vector<Contact> touching = mode & 1 ? list.within_cube(0.5 * cell.side * (1 + 1e-9)) : list.within(reach);
  const double angle = thresholds_.angle_at(nearest.distance + reach);
  if (spokes_are_close(tree_, touching, reach, angle)) return Outcome::kEmpty;
  if (mode & 2 && no_pair_is_salient(tree_, touching, reach, angle)) return Outcome::kEmpty;
  aims_.clear();
  if (mode & 4 && no_pair_of_features(tree_, cones_, cell.centre, 0.5 * cell.side * (1 + 1e-9), nearest, touching, angle, &aims_)) return Outcome::kEmpty;
  ++count.kept;
  count.contacts += list.contacts().size();
  if (aim(cell, list, touching, angle, where, sphere)) {
    ++count.found;
    return Outcome::kFound;
  }
  // A cell touched by the boundary where normals mean nothing can never be dismissed: do not fall into it.
  const bool hopeless = nearest.distance <= reach &&
                        std::any_of(touching.begin(), touching.end(), [](const Contact& c) { return !c.trusted; });
  if (depth >= (hopeless ? std::min(1, extra_levels_) : extra_levels_)) {
    if (std::getenv("V")) {
      const bool boundary = nearest.distance <= reach;
      const Eigen::Vector3d low = cell.centre.array() - cell.side/2 - lower_.array(), high = upper_.array() - cell.centre.array() - cell.side/2;
      const double face = std::min(low.minCoeff(), high.minCoeff()) / grid_.voxel_size;
      const bool near_angle = spokes_are_close(tree_, touching, reach, angle+.05) || no_pair_is_salient(tree_, touching, reach, angle+.05) || (mode & 4 && no_pair_of_features(tree_, cones_, cell.centre, 0.5 * cell.side * (1 + 1e-9), nearest, touching, angle + 0.05));
      char buf[400]; std::snprintf(buf, 400, "U %d %d %d depth %d boundary %d angle %d face %.3f contacts %zu D %.4f  at %.6f %.6f %.6f\n", voxel_.x(), voxel_.y(), voxel_.z(), depth, boundary, near_angle, face, touching.size(), nearest.distance/grid_.voxel_size, cell.centre.x(), cell.centre.y(), cell.centre.z()); notes_ += buf;
      if (std::getenv("W") && !near_angle) for (const Contact& c : touching) { const Eigen::Vector3d n = tree_.normal(c.triangle); std::snprintf(buf, 400, "   t %d D %.4f g %.3f %.3f %.3f n %.3f %.3f %.3f\n", c.triangle, c.distance / grid_.voxel_size, c.direction.x(), c.direction.y(), c.direction.z(), n.x(), n.y(), n.z()); notes_ += buf; }
    }
    return Outcome::kUndecided;
  }
  return search_parts(cell, where, depth, list, sphere);
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

bool VoxelSearch::aim(const Cell& cell, const ContactList& list, const std::vector<Contact>& touching, double angle,
                      Side where, Sphere& sphere) {
  static const bool scouts = !std::getenv("NS");
  if (scouts || aims_.empty()) for (const Vector3d& direction : aims(list, touching, circumradius(cell.side), angle)) {
    const std::optional<Segment> segment = clip(cell, direction);
    if (segment && try_segment(*segment, list, angle, where, sphere)) return true;
  }
  static const int lines = std::getenv("L") ? std::atoi(std::getenv("L")) : 0;
  std::vector<Aim> tried;
  for (const Aim& a : aims_) {
    if (static_cast<int>(tried.size()) >= lines) break;
    if (std::any_of(tried.begin(), tried.end(), [&](const Aim& o) { return std::abs(o.direction.dot(a.direction)) > 0.98 && (o.base - a.base).norm() < 0.2 * cell.side; })) continue;
    tried.push_back(a);
    const std::optional<Segment> segment = clip(cell, a.direction, a.base);
    if (segment && try_segment(*segment, list, angle, where, sphere)) return true;
  }
  return false;
}

// The sheet between the nearest contact and contact j has normal g_j - g0 (equation 2.11) and is about
// (D_j - D0) / |g_j - g0| from the centre. Nearest sheets first, of different normals; the line along g0 last: it
// holds the deep samples of Section 3.2.
std::vector<Vector3d> VoxelSearch::aims(const ContactList& list, const std::vector<Contact>& touching, double reach,
                                        double angle) const {
  const Vector3d& g0 = list.nearest_direction();
  const double d0 = list.nearest_to_centre().distance;
  std::vector<std::pair<double, const Contact*>> order;
  for (const Contact& contact : touching) {
    const double spread = (contact.direction - g0).norm();
    if (spread < std::sin(angle)) continue;  // half of the chord that the angle asks for: spokes turn within the cell
    const double away = (contact.distance - d0) / spread;
    if (away <= 1.3 * reach) order.push_back({away - 0.2 * reach * spread, &contact});
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vector3d> directions;
  for (const auto& [away, contact] : order) {
    const Vector3d normal = (contact->direction - g0).normalized();
    const auto similar = [&](const Vector3d& d) { return d.dot(normal) > 0.9; };
    if (std::any_of(directions.begin(), directions.end(), similar)) continue;
    directions.push_back(normal);
    if (directions.size() == kMostAims) break;
  }
  if (d0 > 0) directions.push_back(-g0);
  return directions;
}

/// The part of the line through the cell's centre that lies in the voxel and in the cell's ball, where its list holds.
std::optional<VoxelSearch::Segment> VoxelSearch::clip(const Cell& cell, const Vector3d& direction, const Vector3d& base) const {
  const double along = base.dot(direction), radius = circumradius(cell.side);
  const double chord = std::sqrt(std::max(0.0, along * along - base.squaredNorm() + radius * radius));
  double from = -along - chord, to = -along + chord;
  const Vector3d point = cell.centre + base;
  for (int a = 0; a < 3; ++a) {
    if (std::abs(direction[a]) < 1e-14) continue;
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

// Bisects towards the larger turn of the gradient until the ends are within h of each other.
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
  for (int i = 0; i < kMostHalvings; ++i) {
    const double distance = std::min(p.nearest.distance, q.nearest.distance);
    const double h = 0.5 * thresholds_.epsilon * sine * sine * distance / (distance + thresholds_.epsilon);
    if ((p.point - q.point).norm() <= h) break;
    End m = look((p.point + q.point) / 2, list);
    (p.gradient.dot(m.gradient) < m.gradient.dot(q.gradient) ? q : p) = m;
  }
  return accept(p, q, list, where, sphere) || accept(q, p, list, where, sphere);
}

// An end is taken if it is salient, in the voxel, passes the growth test of Lemma 2.3 and lies inside: cheap tests
// first.
bool VoxelSearch::accept(const End& here, const End& there, const ContactList& list, Side where, Sphere& sphere) {
  const double angle = half_angle(here.gradient, there.gradient);
  const double distance = here.nearest.distance, radius = safe_radius(tree_, distance);
  if (radius <= 0 || angle < thresholds_.angle_at(distance)) return false;
  if ((here.point - there.point).norm() > thresholds_.epsilon || grid_.voxel_of(here.point) != voxel_) return false;
  const auto distance_at = [&](const Vector3d& p) { return look(p, list).nearest.distance; };
  if (!grows_into_boundary(tree_, here.point, distance, here.gradient, thresholds_.epsilon, distance_at)) return false;
  if (where != Side::kInside && !sides_.inside(here.point, here.nearest)) return false;
  sphere = {here.point, radius, here.gradient, there.gradient, angle, 0, voxel_};
  return true;
}

}  // namespace medial_vk::reference
