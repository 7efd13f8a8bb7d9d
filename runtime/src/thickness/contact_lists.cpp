#include "thickness/contact_lists.h"

#include <bit>
#include <limits>

#include "base/eight_floats.h"

namespace medial_vk {
namespace {

void copy_place(const EightContacts& from, std::size_t place, EightContacts& to, std::size_t into) {
  for (std::size_t axis = 0; axis < 3; ++axis) to.at[axis][into] = from.at[axis][place];
  to.squared[into] = from.squared[place];
  to.share[into] = from.share[place];
  to.number[into] = from.number[place];
}

}  // namespace

void ContactLists::start(double unit, const Slack& slack) {
  slack_ = slack;
  scale_ = ContactScale(unit, slack);
  all_.clear();
  blocks_.clear();
  listed_.clear();
}

void ContactLists::add(const Contact& contact) {
  const std::size_t place = all_.size() % EightContacts::kWidth;
  if (place == 0) blocks_.emplace_back();
  scale_.write(contact, static_cast<std::uint32_t>(all_.size()), blocks_.back(), place);
  all_.push_back(contact);
}

ContactRange ContactLists::range_of(const List& list) const {
  return {std::span(listed_).subspan(list.first, list.count)};
}

ContactLists::Reach ContactLists::narrow(const DirectionCell& cell, double reach, List& list) {
  const std::size_t first_added = list.seen / EightContacts::kWidth;
  most_.clear();
  Reach found = {reach, kNone};
  for (const ContactRange& range :
       {range_of(list), ContactRange{std::span(blocks_).subspan(first_added), list.seen % EightContacts::kWidth}}) {
    const std::uint32_t by = least_reach(scale_, range, cell, found.most, most_);
    if (by == kNone) continue;
    const double by_it = reach_by(all_[by], least_of(along(cell.corners(), all_[by].at)), slack_);
    if (by_it < found.most) found = {by_it, by};
  }
  const std::size_t end = listed_.size();
  std::size_t kept = 0;
  find_above(most_, scale_.share(found.most * cell.bulge()), places_);
  const auto keep = [&](const EightContacts& block, std::uint32_t places) {
    for (; places != 0; places &= places - 1) {
      if (kept % EightContacts::kWidth == 0) listed_.emplace_back();
      copy_place(block, static_cast<std::size_t>(std::countr_zero(places)), listed_.back(),
                 kept++ % EightContacts::kWidth);
    }
  };
  for (std::size_t i = 0; i < list.count; ++i) {
    const EightContacts block = listed_[list.first + i];
    keep(block, places_[i]);
  }
  std::uint32_t places = ~0u << list.seen % EightContacts::kWidth;
  for (std::size_t i = first_added; i < blocks_.size(); ++i) {
    keep(blocks_[i], places & places_[list.count + i - first_added]);
    places = ~0u;
  }
  list = {static_cast<std::uint32_t>(end), static_cast<std::uint32_t>(listed_.size() - end),
          static_cast<std::uint32_t>(size())};
  return found;
}

ContactLists::Reach ContactLists::reach_of(std::uint32_t number, const Point& direction, double reach) const {
  if (number == kNone) return {reach, kNone};
  const double by_it = reach_by(all_[number], dot(direction, all_[number].at), slack_);
  return by_it < reach ? Reach{by_it, number} : Reach{reach, kNone};
}

ContactLists::Reach ContactLists::reach_along(const Point& direction, double reach) const {
  return reach_of(least_reach(scale_, {blocks_}, direction, reach), direction, reach);
}

ContactLists::Reach ContactLists::reach_along(const Point& direction, double reach, const List& list) const {
  return reach_of(least_reach(scale_, range_of(list), direction, reach), direction, reach);
}

double ContactLists::least_squared_distance(const Point& m) const {
  const std::uint32_t nearest = nearest_contact(scale_, {blocks_}, m);
  if (nearest == kNone) return std::numeric_limits<double>::infinity();
  return dot(m, m) - 2 * dot(m, all_[nearest].at) + all_[nearest].squared;
}

}  // namespace medial_vk
