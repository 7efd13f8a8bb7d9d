#include "thickness/direction_polytope.h"

namespace medial_vk {
namespace {

// Products of vertices with a normal have smaller errors than this share of both lengths.
constexpr double kProductRounding = 0x1p-40;

}  // namespace

void DirectionPolytope::start(const CubeFrame& frame, double half_width) {
  vertices_.assign(8, {});
  unused_.clear();
  for (std::uint32_t i = 0; i < 8; ++i) {
    Vertex& vertex = vertices_[i];
    std::array<bool, 3> is_above;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      is_above[axis] = (i >> axis & 1u) != 0;
      vertex.at = vertex.at + (is_above[axis] ? half_width : -half_width) * frame.axes[axis];
    }
    vertex.length = length(vertex.at);
    // Seen from outside, the edges along the axes x, y, z are counterclockwise where an odd number of signs is
    // positive.
    const bool in_order = (is_above[0] != is_above[1]) != is_above[2];
    const std::array<std::uint32_t, 3> axes = in_order ? std::array{0u, 1u, 2u} : std::array{0u, 2u, 1u};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t across = axes[kPrevious[k]];
      vertex.neighbours[k] = i ^ 1u << axes[k];
      vertex.back[k] = static_cast<std::uint8_t>((3 - k) % 3);
      vertex.faces[k] = 2 * across + (is_above[across] ? 1 : 0);
    }
  }
  longest_ = vertices_[0].length;
}

std::uint32_t DirectionPolytope::farthest() const {
  std::uint32_t farthest = kNone;
  double longest = 0;
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
    if (vertices_[i].length <= longest || vertices_[i].is_settled) continue;
    longest = vertices_[i].length;
    farthest = i;
  }
  return farthest;
}

bool DirectionPolytope::cut(const Point& normal, double offset, std::uint32_t face) {
  const std::uint32_t farthest = farthest_along(normal);
  if (!(heights_[farthest] > offset)) return false;
  // Else vertices that are cut off, or new ones, might lie on the other side of the origin.
  if (!(offset > kProductRounding * longest_ * length(normal))) return false;
  const Edge border = find_part(farthest, offset);
  const bool is_disk = border_edges_ >= 3 && walk_around(border);
  if (is_disk) replace_part(offset, face);
  for (const std::uint32_t i : part_) is_cut_[i] = false;
  return is_disk;
}

std::uint32_t DirectionPolytope::farthest_along(const Point& normal) {
  heights_.resize(vertices_.size());
  is_cut_.resize(vertices_.size());
  std::uint32_t farthest = 0;
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
    heights_[i] = dot(vertices_[i].at, normal);
    if (heights_[i] > heights_[farthest]) farthest = i;
  }
  return farthest;
}

/// Collects the connected vertices beyond the plane, and counts their edges to others, of which it returns one.
DirectionPolytope::Edge DirectionPolytope::find_part(std::uint32_t first, double offset) {
  part_.assign(1, first);
  is_cut_[first] = true;
  border_edges_ = 0;
  Edge border = {};
  for (std::size_t done = 0; done < part_.size(); ++done) {
    const Vertex& vertex = vertices_[part_[done]];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t other = vertex.neighbours[k];
      if (!(heights_[other] > offset)) {
        border = {part_[done], k};
        ++border_edges_;
      } else if (!is_cut_[other]) {
        is_cut_[other] = true;
        part_.push_back(other);
      }
    }
  }
  return border;
}

/// Collects the edges that lead out of the part, face by face. False if a walk around it does not meet all of them.
bool DirectionPolytope::walk_around(Edge first) {
  border_.clear();
  Edge edge = first;
  do {
    border_.push_back(edge);
    edge.place = kPrevious[edge.place];
    for (std::uint32_t other = vertices_[edge.end].neighbours[edge.place]; is_cut_[other];
         other = vertices_[edge.end].neighbours[edge.place]) {
      edge = {other, kPrevious[vertices_[edge.end].back[edge.place]]};
    }
  } while (border_.size() < border_edges_ && (edge.end != first.end || edge.place != first.place));
  return border_.size() == border_edges_ && edge.end == first.end && edge.place == first.place;
}

void DirectionPolytope::replace_part(double offset, std::uint32_t face) {
  added_.clear();
  for (std::size_t i = 0; i < border_.size(); ++i) added_.push_back(take_place());
  const std::size_t count = border_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vertex& beyond = vertices_[border_[i].end];
    const std::uint32_t before = beyond.neighbours[border_[i].place], place = beyond.back[border_[i].place];
    Vertex& kept = vertices_[before];
    Vertex& added = vertices_[added_[i]];
    const double from = heights_[before], to = heights_[border_[i].end];
    added.at = kept.at + ((offset - from) / (to - from)) * (beyond.at - kept.at);
    added.length = length(added.at);
    added.neighbours = {before, added_[(i + count - 1) % count], added_[(i + 1) % count]};
    added.back = {static_cast<std::uint8_t>(place), 2, 1};
    added.faces = {kept.faces[kPrevious[place]], face, kept.faces[place]};
    added.is_settled = false;
    kept.neighbours[place] = added_[i];
    kept.back[place] = 0;
  }
  for (const std::uint32_t i : part_) {
    vertices_[i].at = {0, 0, 0};
    vertices_[i].length = 0;
    unused_.push_back(i);
  }
}

std::uint32_t DirectionPolytope::take_place() {
  if (unused_.empty()) {
    vertices_.emplace_back();
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }
  const std::uint32_t place = unused_.back();
  unused_.pop_back();
  return place;
}

}  // namespace medial_vk
