#include "plane/shapes/windings.h"

#include <algorithm>
#include <set>
#include <utility>

#include "plane/shapes/orientation.h"

namespace medial_vk::plane {
namespace {

/// Edges that the sweep line crosses, from below. A vertical edge counts as one that leans to the right a little, as
/// the order of events by x and then by y has it.
class Sweep {
 public:
  explicit Sweep(const Arrangement& arrangement) : arrangement_(arrangement), status_(Below{this}) {
    for (const CountedEdge& edge : arrangement.edges) {
      auto [begin, end] = edge.ends;
      const bool is_forward = precedes(point(begin), point(end));
      if (!is_forward) std::swap(begin, end);
      spans_.push_back({begin, end, is_forward});
    }
    above_.resize(spans_.size());
    below_.resize(spans_.size());
  }

  std::vector<EdgeWindings> run() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> begins, ends;  // point, edge
    for (std::uint32_t e = 0; e < spans_.size(); ++e) {
      begins.emplace_back(spans_[e].begin, e);
      ends.emplace_back(spans_[e].end, e);
    }
    const auto by_point = [&](const auto& a, const auto& b) {
      if (a.first == b.first) return a.second < b.second;
      return precedes(point(a.first), point(b.first)) || (point(a.first) == point(b.first) && a.first < b.first);
    };
    std::ranges::sort(begins, by_point);
    std::ranges::sort(ends, by_point);
    std::vector<Status::iterator> place(spans_.size());
    std::size_t ended = 0;
    for (std::size_t i = 0; i < begins.size();) {
      const std::uint32_t at = begins[i].first;
      for (; ended < ends.size() && !precedes(point(at), point(ends[ended].first)); ++ended) {
        status_.erase(place[ends[ended].second]);
      }
      const std::size_t first = i;
      for (; i < begins.size() && begins[i].first == at; ++i) {
        place[begins[i].second] = status_.insert(begins[i].second);
      }
      number(first, i, begins, place);
    }
    return by_direction();
  }

 private:
  struct Span {
    std::uint32_t begin, end;  // points, in the order of the sweep
    bool is_forward;
  };
  struct Below {
    const Sweep* sweep;
    bool operator()(std::uint32_t a, std::uint32_t b) const { return sweep->is_below(a, b); }
  };
  using Status = std::multiset<std::uint32_t, Below>;

  Vec2 point(std::uint32_t i) const { return arrangement_.points[i]; }

  /// Where both are crossed: edges meet in common ends only, so the later begin decides.
  bool is_below(std::uint32_t a, std::uint32_t b) const {
    if (a == b) return false;
    const Span &s = spans_[a], &t = spans_[b];
    const bool a_is_older = precedes(point(s.begin), point(t.begin));
    const Span &older = a_is_older ? s : t, &newer = a_is_older ? t : s;
    int side = orientation(point(older.begin), point(older.end), point(newer.begin));
    if (side == 0) side = orientation(point(older.begin), point(older.end), point(newer.end));
    if (side == 0) return a < b;
    return (side > 0) == a_is_older;
  }

  /// The winding numbers of the edges that were inserted at one point, from the lowest up.
  void number(std::size_t first, std::size_t last, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& begins,
              const std::vector<Status::iterator>& place) {
    Status::iterator lowest = place[begins[first].second];
    for (std::size_t i = first + 1; i < last; ++i) {
      if (is_below(begins[i].second, *lowest)) lowest = place[begins[i].second];
    }
    std::int64_t winding = lowest == status_.begin() ? 0 : above_[*std::prev(lowest)];
    for (std::size_t i = first; i < last && lowest != status_.end(); ++i, ++lowest) {
      const std::uint32_t e = *lowest;
      const std::int64_t times = arrangement_.edges[e].times;
      below_[e] = winding;
      winding += spans_[e].is_forward ? times : -times;  // the left of an edge to the right is above it
      above_[e] = winding;
    }
  }

  std::vector<EdgeWindings> by_direction() const {
    std::vector<EdgeWindings> result;
    result.reserve(spans_.size());
    for (std::size_t e = 0; e < spans_.size(); ++e) {
      EdgeWindings w = {above_[e], below_[e]};
      if (!spans_[e].is_forward) std::swap(w.left, w.right);
      result.push_back(w);
    }
    return result;
  }

  const Arrangement& arrangement_;
  std::vector<Span> spans_;
  std::vector<std::int64_t> above_, below_;
  Status status_;
};

}  // namespace

std::vector<EdgeWindings> windings(const Arrangement& arrangement) { return Sweep(arrangement).run(); }

}  // namespace medial_vk::plane
