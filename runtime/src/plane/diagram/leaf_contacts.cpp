#include "plane/diagram/leaf_contacts.h"

#include <algorithm>

namespace medial_vk::plane {
namespace {

static_assert(2 * CellTree::kLeafSites <= 64, "one bit for each contact");

/// Vertices are accepted with differences of tie(r) in the distances of contacts and of other sites, as far from the
/// cell. This is above six of them, as no radius is above 1.5.
constexpr double kPairSlack = 0x1p-39;
static_assert(kPairSlack > 6 * tie(1.5));

}  // namespace

/// A segment counts on the sides that are wanted and that the cell lies on.
void LeafContacts::set(const Cell& cell) {
  contacts_.clear();
  bounds_.clear();
  set_distances(cell);
  for (const std::uint32_t site : cell.sites) {
    if (sites_.is_point(site)) {
      add(cell, {site, Side::kLeft});
      continue;
    }
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const auto is_beside = [&](Vec2 corner) { return sites_.segment(site).height(corner, side) > -tie(1); };
      if (allows(wanted_, side) && std::ranges::any_of(cell.corners, is_beside)) add(cell, {site, side});
    }
  }
  partners_.assign(contacts_.size(), 0);
  means_.resize(corners_);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    for (std::size_t k = i + 1; k < contacts_.size(); ++k) {
      if (contacts_[i].site == contacts_[k].site) continue;
      const double *a = bounds_.data() + i * corners_, *b = bounds_.data() + k * corners_;
      for (std::size_t c = 0; c < corners_; ++c) means_[c] = (a[c] + b[c]) / 2 - kPairSlack;
      if (!has_nearer()) partners_[i] |= std::uint64_t{1} << k;
    }
  }
}

void LeafContacts::set_distances(const Cell& cell) {
  corners_ = cell.corners.size();
  farthest_.clear();
  for (const std::uint32_t site : cell.sites) {
    for (const Vec2 corner : cell.corners) farthest_.push_back(sites_.distance_to(site, corner));
  }
}

/// With the linear part of its distance at the centre, a lower bound as distances are convex.
void LeafContacts::add(const Cell& cell, Contact contact) {
  contacts_.push_back(contact);
  if (!sites_.is_point(contact.site)) {
    for (const Vec2 corner : cell.corners) bounds_.push_back(sites_.segment(contact.site).height(corner, contact.side));
    return;
  }
  const Vec2 from = cell.centre - sites_.point(contact.site);
  const double distance = length(from);
  const Vec2 away = distance > 0 ? (1 / distance) * from : Vec2();
  for (const Vec2 corner : cell.corners) bounds_.push_back(distance + dot(away, corner - cell.centre));
}

/// Whether some site is nearer than the means in all of the cell.
bool LeafContacts::has_nearer() const {
  for (const double* site = farthest_.data(); site != farthest_.data() + farthest_.size(); site += corners_) {
    std::size_t c = 0;
    while (c < corners_ && means_[c] > site[c]) ++c;
    if (c == corners_) return true;
  }
  return false;
}

}  // namespace medial_vk::plane
