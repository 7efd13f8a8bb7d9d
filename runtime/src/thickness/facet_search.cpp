#include "thickness/facet_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk {
namespace {

// Planes are this much closer than the target, so that rounding does not decide whether they bound it.
constexpr double kPlaneInset = 0x1p-30;

// Probed centres are closer by this share, so that rounding does not decide whether their balls come within delta.
constexpr double kProbeInset = 0x1p-20;

// A vertex that is farther away than the target is cut off by a plane that is closer by this share of delta.
constexpr double kLeastGain = 0.125;

constexpr int kMostSteps = 400;

}  // namespace

void FacetSearch::run(const CubeFrame& frame) {
  build(frame);
  refine(frame);
  collect_open();
}

void FacetSearch::build(const CubeFrame& frame) {
  built_for_ = balls_.least_reach();
  polytope_.start(frame, balls_.most_reach());
  faces_.assign(DirectionPolytope::kCubeFaces, {});
}

/// Cuts off the farthest vertex, again and again, as long as something is known or found beyond which there is nothing.
/// A greater target moves all planes: the polytope is built again.
void FacetSearch::refine(const CubeFrame& frame) {
  for (int steps = 0; steps < kMostSteps && !balls_.is_exhausted(); ++steps) {
    if (balls_.least_reach() != built_for_) build(frame);
    const std::uint32_t number = polytope_.farthest();
    if (number == DirectionPolytope::kNone || polytope_.vertices()[number].length <= built_for_) return;
    const Vertex vertex = polytope_.vertices()[number];
    const Point direction = (1 / vertex.length) * vertex.at;
    if (cut_by_known(vertex, direction)) continue;
    if (!is_within_contacts(vertex)) {
      const double enough = built_for_ * (1 - kPlaneInset);
      if (balls_.recall(direction, enough) < enough && cut_by_known(vertex, direction)) continue;
      probe(vertex, direction);
      if (balls_.least_reach() != built_for_ || cut_by_known(vertex, direction)) continue;
    }
    polytope_.settle(number);
  }
}

/// Computes the distance of a centre whose ball, if it comes within delta, is larger than the target, or as far away as
/// the vertex. If it is larger, the largest ball in this direction is found.
void FacetSearch::probe(const Vertex& vertex, const Point& direction) {
  const double reach = balls_.contacts().reach_along(direction, balls_.most_reach()).most;
  const double distance = std::min({reach, vertex.length, built_for_ + balls_.slack().distance});
  balls_.probe_at(direction, distance * (1 - kProbeInset));
  if (balls_.least_reach() != built_for_) balls_.probe(direction, reach);
}

bool FacetSearch::cut_by_known(const Vertex& vertex, const Point& direction) {
  return cut_by_contact(vertex, direction) || cut_by_other_side(vertex, direction);
}

/// True if the faces that meet here are likely to be closed by their contacts (is_within_contact()).
bool FacetSearch::is_within_contacts(const Vertex& vertex) {
  const double most = balls_.target_of_contacts(), from = balls_.least_reach() / kBoundRounding;
  return std::ranges::all_of(vertex.faces, [&](std::uint32_t number) {
    const Face& face = faces_[number];
    if (face.kind != Face::Kind::kContact) return false;
    const Point contact = balls_.contacts().contact(face.contact).at;
    return length(vertex.at - contact) <= most && length((from / vertex.length) * vertex.at - contact) <= most;
  });
}

/// A centre at a distance of at most s from p whose ball comes within delta has m.q <= (|q|^2 - delta^2) / 2 + delta s.
/// No larger ball than the target is farther away than that and delta.
bool FacetSearch::cut_by_contact(const Vertex& vertex, const Point& direction) {
  const ContactLists::Reach found = balls_.contacts().reach_along(direction, std::numeric_limits<double>::infinity());
  const double enough = std::max(built_for_ * (1 - kPlaneInset), vertex.length - kLeastGain * balls_.delta());
  if (found.by == ContactLists::kNone || found.most > enough) return false;
  const Contact contact = balls_.contacts().contact(found.by);
  const Slack& slack = balls_.slack();
  const double reach = std::min(vertex.length, built_for_ + slack.distance);
  const double offset = 0.5 * (contact.squared - slack.distance * slack.distance) + slack.product * reach;
  if (!(offset > 0) || dot(vertex.at, contact.at) <= offset) return false;
  return cut(contact.at, offset, {.kind = Face::Kind::kContact, .contact = found.by});
}

/// A ball on the other side holds a point of each direction at a small angle to that of its centre.
bool FacetSearch::cut_by_other_side(const Vertex& vertex, const Point& direction) {
  constexpr double kLeastCosine = 0.1, kMostCosine = 0.9;
  if (!balls_.is_closed_mesh()) return false;
  for (const Ball& other : balls_.others()) {
    const double squared = dot(other.centre, other.centre), radius = balls_.radius_of_other(other);
    const double beyond = std::max(0.0, squared - radius * radius) / squared;
    const double cosine = std::sqrt(kLeastCosine * kLeastCosine + 1.1 * beyond);
    const Point towards = (1 / std::sqrt(squared)) * other.centre;
    if (!(cosine < kMostCosine) || !(dot(vertex.at, towards) > cosine * built_for_)) continue;
    if (dot(direction, towards) <= cosine) continue;
    if (cut(towards, cosine * built_for_, {.kind = Face::Kind::kOtherSide, .other = other})) return true;
  }
  return false;
}

bool FacetSearch::cut(const Point& normal, double offset, const Face& face) {
  if (!polytope_.cut(normal, offset, static_cast<std::uint32_t>(faces_.size()))) return false;
  faces_.push_back(face);
  return true;
}

void FacetSearch::collect_open() {
  open_.clear();
  measure_faces();
  for (std::uint32_t number = 0; number < faces_.size(); ++number) {
    const Face& face = faces_[number];
    if (!face.is_present) continue;
    const double reach = reach_of(face);
    if (reach <= balls_.least_reach() || is_on_other_side(face)) {
      if (face.kind == Face::Kind::kContact) balls_.mark_used(face.contact);
      continue;
    }
    collect_corners(face, number);
    if (face.kind == Face::Kind::kContact && is_within_contact(face, reach)) {
      balls_.mark_used(face.contact);
      continue;
    }
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      open_.push_back({{corners_[0], corners_[i - 1], corners_[i]}, reach});
    }
  }
}

void FacetSearch::measure_faces() {
  for (Face& face : faces_) face.is_present = false;
  for (std::uint32_t number = 0; number < polytope_.vertices().size(); ++number) {
    const Vertex& vertex = polytope_.vertices()[number];
    if (vertex.length == 0) continue;
    for (std::uint32_t place = 0; place < 3; ++place) {
      Face& face = faces_[vertex.faces[place]];
      if (!face.is_present) face.least_product = std::numeric_limits<double>::infinity();
      face.is_present = true;
      face.first = number;
      face.place = place;
      if (face.kind == Face::Kind::kNothing) continue;
      const bool is_contact = face.kind == Face::Kind::kContact;
      const Point towards = is_contact ? balls_.contacts().contact(face.contact).at : face.other.centre;
      face.least_product = std::min(face.least_product, dot(vertex.at, towards) / vertex.length);
    }
  }
}

double FacetSearch::reach_of(const Face& face) const {
  if (face.kind != Face::Kind::kContact) return balls_.most_reach();
  const double reach = reach_by(balls_.contacts().contact(face.contact), face.least_product, balls_.slack());
  return std::min(reach, balls_.most_reach());
}

bool FacetSearch::is_on_other_side(const Face& face) const {
  return face.kind == Face::Kind::kOtherSide && balls_.are_on_other_side(face.other, face.least_product);
}

/// True if the contact is so close to all centres in question that their balls are not larger than the target. They are
/// in the pyramid with the apex p whose base is the plane of the contact for the reach, and outside the ball around p
/// of the least reach. So they are in the hull of the corners of the base and of the points where edges leave that
/// ball.
bool FacetSearch::is_within_contact(const Face& face, double reach) {
  const Contact contact = balls_.contacts().contact(face.contact);
  const Slack& slack = balls_.slack();
  const double most = balls_.target_of_contacts(), from = balls_.least_reach() / kBoundRounding;
  const double plane =
      kBoundRounding * (0.5 * (contact.squared - slack.distance * slack.distance) + slack.product * reach);
  const auto is_near = [&](const Point& m) { return length(m - contact.at) * kBoundRounding <= most; };
  return std::ranges::all_of(corners_, [&](const Point& corner) {
    const double product = dot(corner, contact.at) - slack.product + slack.distance;  // lessened by its rounding
    if (!(product > 0)) return false;
    const double distance = plane / product * kBoundRounding;
    return is_near(distance * corner) && (distance <= from || is_near(from * corner));
  });
}

void FacetSearch::collect_corners(const Face& face, std::uint32_t number) {
  corners_.clear();
  std::uint32_t at = face.first, place = face.place;
  do {
    const Vertex& vertex = polytope_.vertices()[at];
    corners_.push_back((1 / vertex.length) * vertex.at);
    at = vertex.neighbours[place];
    place = DirectionPolytope::kPrevious[vertex.back[place]];
  } while (at != face.first && polytope_.vertices()[at].faces[place] == number);
}

}  // namespace medial_vk
