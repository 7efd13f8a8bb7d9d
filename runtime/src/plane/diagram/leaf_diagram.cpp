#include "plane/diagram/leaf_diagram.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>
#include <utility>

namespace medial_vk::plane {
namespace {

constexpr std::size_t kManyContacts = 24;
constexpr double kShortSide = 0x1p-46;
constexpr double kFar = std::numeric_limits<double>::infinity();  // a radius above every threshold

/// From a point to a contact.
double distance_to(const SiteSet& sites, Contact contact, Vec2 x) {
  if (sites.is_point(contact.site)) return distance(sites.point(contact.site), x);
  return sites.segment(contact.site).height(x, contact.side);
}

Vec2 direction_to(const SiteSet& sites, Contact contact, Vec2 x) {
  return sites.is_point(contact.site) ? sites.point(contact.site) - x
                                      : -sites.segment(contact.site).normal(contact.side);
}

/// The same among directions in angular order: the best partner of each is the first, on either side of its opposite,
/// that it can pair with.
double greatest_of_many(const SiteSet& sites, Wanted wanted, std::span<const Contact> contacts, Vec2 x) {
  std::vector<std::pair<double, Contact>> around;
  around.reserve(contacts.size());
  for (const Contact contact : contacts) {
    const Vec2 way = direction_to(sites, contact, x);
    around.emplace_back(std::atan2(way.y, way.x), contact);
  }
  std::ranges::sort(around);
  double greatest = 0;
  const std::size_t all = around.size();
  for (const auto& [angle, contact] : around) {
    const double opposite = angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi;
    const auto after = std::ranges::lower_bound(around, std::pair(opposite, Contact()));
    const std::size_t start = static_cast<std::size_t>(after - around.begin());
    for (const std::size_t step : {std::size_t{1}, all - 1}) {
      std::size_t at = step == 1 ? start % all : (start + all - 1) % all;
      for (std::size_t tried = 0; tried < all; ++tried, at = (at + step) % all) {
        const double apart = std::fabs(angle - around[at].first);
        const double half = std::min(apart, 2 * std::numbers::pi - apart) / 2;
        if (half <= greatest) break;
        if (!can_pair(sites, wanted, contact, around[at].second)) continue;
        greatest = half;
        break;
      }
    }
  }
  return greatest;
}

}  // namespace

bool can_pair(const SiteSet& sites, Wanted wanted, Contact a, Contact b) {
  if (a.site == b.site || sites.are_joined(a.site, b.site)) return false;
  if (wanted == Wanted::kBetweenOwners) return sites.owner(a.site) != sites.owner(b.site);
  return sites.is_point(a.site) || sites.is_point(b.site) || a.side == b.side;
}

/// Whether a point joins two segments so nearly in line that from this distance rounding decides which of the three is
/// nearest: beside the point, the distance of the segment's line is less by no more than radius turn^2 / 2.
bool is_straight_joint(const SiteSet& sites, std::uint32_t site, double radius) {
  if (!sites.is_point(site) || sites.segments_of(site).size() != 2) return false;
  const Vec2 a = sites.leaving(site, sites.segments_of(site)[0]), b = sites.leaving(site, sites.segments_of(site)[1]);
  const double turn = cross(a, b);
  return dot(a, b) < 0 && radius * turn * turn <= 8 * tie(radius);
}

bool can_touch(const SiteSet& sites, Wanted wanted, Contact contact, const Circle& circle) {
  const double slack = tie(circle.radius);
  if (std::fabs(distance_to(sites, contact, circle.centre) - circle.radius) > slack) return false;
  const double outside = sites.outside_of_region(contact.site, circle.centre);
  if (outside > slack &&
      !(is_straight_joint(sites, contact.site, circle.radius) && outside * outside <= 2 * circle.radius * slack)) {
    return false;
  }
  if (wanted == Wanted::kBetweenOwners || !sites.is_point(contact.site)) return true;
  return sites.segments_of(contact.site).empty() || allows(wanted, sites.side_of(contact.site, circle.centre));
}

bool is_empty(const SiteSet& sites, std::span<const std::uint32_t> list, const Circle& circle) {
  const double least = circle.radius - tie(circle.radius);
  return std::ranges::all_of(list, [&](std::uint32_t s) { return sites.distance_to(s, circle.centre) >= least; });
}

double greatest_object_angle(const SiteSet& sites, Wanted wanted, std::span<const Contact> contacts, Vec2 x) {
  if (contacts.size() > kManyContacts) return greatest_of_many(sites, wanted, contacts, x);
  double greatest = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t k = i + 1; k < contacts.size(); ++k) {
      if (!can_pair(sites, wanted, contacts[i], contacts[k])) continue;
      const double angle = angle_between(direction_to(sites, contacts[i], x), direction_to(sites, contacts[k], x));
      greatest = std::max(greatest, angle / 2);
    }
  }
  return greatest;
}

void LeafDiagram::find(const Cell& cell, DiagramParts& parts) {
  contacts_.set(cell);
  set_sides(cell);
  find_vertices(cell, parts);
  find_crossing_pairs(cell, parts);
}

/// Sides so short that rounding decides where they point are left out.
void LeafDiagram::set_sides(const Cell& cell) {
  sides_.clear();
  for (std::size_t i = 0; i < cell.corners.size(); ++i) {
    const Vec2 corner = cell.corners[i], side = cell.corners[(i + 1) % cell.corners.size()] - corner;
    if (length(side) < kShortSide) continue;
    const Vec2 normal = left_of(unit(side));
    sides_.push_back({normal, dot(normal, corner)});
  }
}

bool LeafDiagram::is_in_cell(const Cell& cell, const Circle& circle) const {
  const double slack = tie(circle.radius);
  return distance(circle.centre, cell.centre) <= cell.reach + slack &&
         std::ranges::all_of(sides_, [&](const Line& side) { return side.height(circle.centre) >= -slack; });
}

/// Pairs that no vertex has.
bool LeafDiagram::excludes(Contact a, Contact b) const {
  const bool are_segments = !sites_.is_point(a.site) && !sites_.is_point(b.site);
  return are_segments && query_.wanted != Wanted::kBetweenOwners && a.side != b.side;
}

void LeafDiagram::find_vertices(const Cell& cell, DiagramParts& parts) {
  circles_.clear();
  const std::vector<Contact>& all = contacts_.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::uint64_t later = contacts_.partners(i); later != 0; later &= later - 1) {
      const auto j = static_cast<std::size_t>(std::countr_zero(later));
      if (excludes(all[i], all[j])) continue;
      for (std::uint64_t both = later & contacts_.partners(j); both != 0; both &= both - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(both));
        if (excludes(all[i], all[k]) || excludes(all[j], all[k])) continue;
        try_circles(cell, {all[i], all[j], all[k]}, parts);
      }
    }
  }
}

/// A step of Newton's method leaves an error of the second order in the one that it removes: from an error e of a
/// circle of radius r, about e^2 / r. A circle that is accepted within tie(r) was nearer than 2^-20 r before; this test
/// allows 2^-16 r, and leaves out those that even so lie outside, or have a site inside.
bool LeafDiagram::can_become_vertex(const Cell& cell, const Circle& rough) const {
  const double loose = 0x1p-16 * (rough.radius + cell.reach), least = rough.radius - 2 * loose;
  return std::ranges::all_of(sides_, [&](const Line& side) { return side.height(rough.centre) >= -loose; }) &&
         std::ranges::all_of(cell.sites, [&](std::uint32_t s) { return sites_.distance_to(s, rough.centre) >= least; });
}

void LeafDiagram::try_circles(const Cell& cell, const std::array<Contact, 3>& three, DiagramParts& parts) {
  const Circles rough = rough_circles(sites_, three, cell.centre);
  for (int n = 0; n < rough.count; ++n) {
    Circle circle = rough.circles[static_cast<std::size_t>(n)];
    if (!can_become_vertex(cell, circle)) continue;
    polish(sites_, three, circle);
    const auto is_touched = [&](Contact c) { return touches(c, circle); };
    if (is_in_cell(cell, circle) && std::ranges::all_of(three, is_touched) && is_empty(sites_, cell.sites, circle)) {
      add_vertex(circle, parts);
    }
  }
}

void LeafDiagram::add_vertex(const Circle& circle, DiagramParts& parts) {
  for (const Circle& known : circles_) {
    if (distance(known.centre, circle.centre) <= tie(circle.radius)) return;
  }
  circles_.push_back(circle);
  touching_.clear();
  for (const Contact contact : contacts_.all()) {
    if (touches(contact, circle)) touching_.push_back(contact);
  }
  // The vertex ends salient edges even where no pair is salient there.
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    for (std::size_t k = i + 1; k < touching_.size(); ++k) add_pair(touching_[i], touching_[k], parts);
  }
  const double greatest = greatest_object_angle(sites_, query_.wanted, touching_, circle.centre);
  if (greatest < query_.least_angle(circle.radius + tie(circle.radius)) - kLeastAngle / 2) return;
  std::ranges::sort(touching_);
  parts.vertices.push_back(
      {circle, static_cast<std::uint32_t>(parts.contacts.size()), static_cast<std::uint32_t>(touching_.size())});
  parts.contacts.insert(parts.contacts.end(), touching_.begin(), touching_.end());
}

void LeafDiagram::add_pair(Contact a, Contact b, DiagramParts& parts) const {
  if (!can_pair(sites_, query_.wanted, a, b)) return;
  const std::optional<Bisector> curve = bisector_of(sites_, a, b);
  if (curve && curve->has_angle(query_.least_angle(kFar))) parts.pairs.push_back({std::min(a, b), std::max(a, b)});
}

/// An edge of the diagram ends at vertices. One without a vertex in the cell crosses its border.
void LeafDiagram::find_crossing_pairs(const Cell& cell, DiagramParts& parts) {
  const std::vector<Contact>& all = contacts_.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::uint64_t later = contacts_.partners(i); later != 0; later &= later - 1) {
      const Contact a = all[i], b = all[static_cast<std::size_t>(std::countr_zero(later))];
      if (!can_pair(sites_, query_.wanted, a, b)) continue;
      const std::optional<Bisector> curve = bisector_of(sites_, a, b);
      if (!curve || !curve->has_angle(query_.least_angle(kFar))) continue;
      if (is_crossed(cell, a, b, *curve)) parts.pairs.push_back({std::min(a, b), std::max(a, b)});
    }
  }
}

bool LeafDiagram::is_crossed(const Cell& cell, Contact a, Contact b, const Bisector& curve) const {
  return std::ranges::any_of(sides_, [&](const Line& side) {
    const auto crossings = curve.with_line(side.normal, side.value);
    for (int n = 0; n < crossings.count; ++n) {
      const double t = crossings.t[static_cast<std::size_t>(n)];
      const Circle circle = {curve.at(t), curve.radius_at(t)};
      if (circle.radius > 0 && is_in_cell(cell, circle) && touches(a, circle) && touches(b, circle) &&
          is_empty(sites_, cell.sites, circle)) {
        return true;
      }
    }
    return false;
  });
}

}  // namespace medial_vk::plane
