#include "any_boundary/aimed_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

// A step goes to where the two contacts are equally far. Between plane walls the first one ends the search; between
// curved ones the remaining way is about squared by each.
constexpr int kMostSteps = 48;
// Of the object angle: lines whose contacts come closer together are given up.
constexpr double kLeastShare = 0.5;

double squared_distance(const Point& p, const Point& q) { return dot(p - q, p - q); }

/// On the line, where a and b are equally far.
Point tie(const AimedLine& line) {
  const double at_begin = squared_distance(line.begin, line.b) - squared_distance(line.begin, line.a);
  const double at_end = squared_distance(line.end, line.a) - squared_distance(line.end, line.b);
  const double sum = std::max(0.0, at_begin) + std::max(0.0, at_end);
  const double share = sum > 0 ? std::max(0.0, at_begin) / sum : 0.5;
  return line.begin + share * (line.end - line.begin);
}

}  // namespace

Point foot_on_bisector(const Point& p, const Point& a, const Point& b) {
  const Point across = b - a;
  return p + ((squared_distance(p, b) - squared_distance(p, a)) / (2 * dot(across, across))) * across;
}

void LineNarrowing::find_contacts(std::vector<AimedLine>& lines) {
  points_.clear();
  points_.reserve(2 * lines.size());
  for (const AimedLine& line : lines) {
    points_.push_back(line.begin);
    points_.push_back(line.end);
  }
  answers_.resize(points_.size());
  queries_.nearest(points_, answers_);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].a = answers_[2 * i];
    lines[i].b = answers_[2 * i + 1];
  }
}

const std::vector<std::optional<ApproximateBall>>& LineNarrowing::narrow(std::vector<AimedLine>& lines) {
  find_contacts(lines);
  found_.assign(lines.size(), std::nullopt);
  open_.resize(lines.size());
  std::iota(open_.begin(), open_.end(), 0u);
  for (int i = 0; i < kMostSteps && !open_.empty(); ++i) step(lines);
  leave_out_those_outside();
  return found_;
}

/// One query for each open line, at its tie.
void LineNarrowing::step(std::vector<AimedLine>& lines) {
  points_.clear();
  for (const std::uint32_t i : open_) points_.push_back(tie(lines[i]));
  answers_.resize(points_.size());
  queries_.nearest(points_, answers_);
  still_open_.clear();
  for (std::size_t k = 0; k < open_.size(); ++k) {
    AimedLine& line = lines[open_[k]];
    const Contacts contacts = {points_[k], answers_[k], line.a, line.b};
    if (axis_distance(contacts, queries_.error()) <= most_) {
      if (grid_.holds(line.voxel, contacts.at)) {
        found_[open_[k]] = ball_at(contacts, line.voxel, salience_, queries_.error(), most_);
      }
      continue;
    }
    // The boundary between a and b is probably smooth; parts of the cell are searched again.
    if (object_angle(contacts) < kLeastShare * salience_.least_angle(length(contacts.nearest - contacts.at))) continue;
    const bool is_a = squared_distance(answers_[k], line.a) <= squared_distance(answers_[k], line.b);
    (is_a ? line.begin : line.end) = points_[k];
    (is_a ? line.a : line.b) = answers_[k];
    still_open_.push_back(open_[k]);
  }
  open_.swap(still_open_);
}

void LineNarrowing::leave_out_those_outside() {
  if (!queries_.has_inside()) return;
  std::vector<std::size_t> at;
  points_.clear();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (!found_[i]) continue;
    at.push_back(i);
    points_.push_back(found_[i]->sphere.centre);
  }
  inside_.resize(points_.size());
  queries_.contains(points_, inside_);
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (inside_[i] == 0) found_[at[i]].reset();
  }
}

}  // namespace medial_vk::any_boundary
