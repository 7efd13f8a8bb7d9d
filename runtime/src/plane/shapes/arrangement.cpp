#include "plane/shapes/arrangement.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"
#include "plane/shapes/meetings.h"
#include "plane/shapes/orientation.h"

namespace medial_vk::plane {
namespace {

// A cut moves the parts of a segment by rounding, which can make them meet others: then once more. Two rounds suffice
// but for segments that nearly coincide.
constexpr int kMostRounds = 24;

/// Where a segment is to be cut.
struct Cut {
  std::uint32_t edge;
  double position;  // along the segment
  std::uint32_t point;

  auto operator<=>(const Cut&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
};

/// Edges with the lesser end first, each once, those of a single point left out.
void unite(std::vector<CountedEdge>& edges) {
  std::erase_if(edges, [](const CountedEdge& e) { return e.ends[0] == e.ends[1]; });
  for (CountedEdge& e : edges) {
    if (e.ends[0] < e.ends[1]) continue;
    std::swap(e.ends[0], e.ends[1]);
    e.times = -e.times;
  }
  std::ranges::sort(edges);
  std::size_t kept = 0;
  for (const CountedEdge& e : edges) {
    if (kept > 0 && edges[kept - 1].ends == e.ends) {
      edges[kept - 1].times += e.times;
    } else {
      edges[kept++] = e;
    }
  }
  edges.resize(kept);
}

class Arranger {
 public:
  Arranger(std::vector<Vec2> points, const std::vector<CountedEdge>& edges, const Frame& frame) : frame_(frame) {
    result_.points = std::move(points);
    result_.edges = edges;
  }

  /// Whether anything met.
  bool round(unsigned threads, const LoopWatch& watch) {
    unite_points();
    const SiteSet sites = sites_in_use();
    const std::vector<Meeting> meetings = find_meetings(sites, threads, watch);
    if (meetings.empty()) return false;
    merged_.reset(result_.points.size());
    cuts_.clear();
    const auto old_points = static_cast<std::uint32_t>(result_.points.size());
    for (const Meeting& m : meetings) apply(sites, m);
    cut_edges(old_points);
    return true;
  }

  /// Points with the same coordinates become one, so that no edge is without length.
  void unite_points() {
    merge_equal_points();
    unite(result_.edges);
  }

  Arrangement& result() { return result_; }

 private:
  void merge_equal_points() {
    std::vector<std::uint32_t> order(result_.points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const std::vector<Vec2>& points = result_.points;
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const Vec2 p = points[a], q = points[b];
      return p == q ? a < b : precedes(p, q);
    });
    target_.resize(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_copy = i > 0 && points[order[i]] == points[order[i - 1]];
      target_[order[i]] = is_copy ? target_[order[i - 1]] : order[i];
    }
    for (CountedEdge& e : result_.edges) e.ends = {target_[e.ends[0]], target_[e.ends[1]]};
  }

  /// The edges and their ends, without points that became others.
  SiteSet sites_in_use() {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> place(result_.points.size(), kUnused);
    std::vector<Vec2> points;
    std::vector<SiteSet::Edge> ends;
    in_use_.clear();
    ends.reserve(result_.edges.size());
    for (const CountedEdge& e : result_.edges) {
      for (const std::uint32_t end : e.ends) {
        if (place[end] != kUnused) continue;
        place[end] = static_cast<std::uint32_t>(points.size());
        points.push_back(result_.points[end]);
        in_use_.push_back(end);
      }
      ends.push_back({place[e.ends[0]], place[e.ends[1]]});
    }
    return SiteSet(std::move(points), ends, {}, {});
  }

  void apply(const SiteSet& sites, const Meeting& m) {
    const std::uint32_t first_edge = sites.points();
    if (sites.is_point(m.first) && sites.is_point(m.second)) {
      result_.merged_points += merged_.join(in_use_[m.first], in_use_[m.second]) ? 1 : 0;
    } else if (sites.is_point(m.first)) {
      const Segment& s = sites.segment(m.second);
      const double position = s.position(sites.point(m.first));
      // Near an end the points are merged.
      if (std::min(position, s.length - position) <= kSnap) return;
      cuts_.push_back({m.second - first_edge, position, in_use_[m.first]});
      ++result_.touching_points;
    } else {
      add_crossing(sites, m);
    }
  }

  void add_crossing(const SiteSet& sites, const Meeting& m) {
    const Segment &a = sites.segment(m.first), &b = sites.segment(m.second);
    const double at_begin = b.height(a.begin, Side::kLeft);
    const double at_end = b.height(sites.point(a.ends[1]), Side::kLeft);
    const double share = std::clamp(at_begin / (at_begin - at_end), 0.0, 1.0);
    const Vec2 x = frame_.representable(a.begin + share * a.length * a.along);
    for (const Segment* s : {&a, &b}) {
      for (const std::uint32_t end : s->ends) {
        if (distance(x, sites.point(end)) <= kSnap) return;  // the end lies on the other segment
      }
    }
    const auto point = static_cast<std::uint32_t>(result_.points.size());
    result_.points.push_back(x);
    for (const std::uint32_t site : {m.first, m.second}) {
      cuts_.push_back({site - sites.points(), sites.segment(site).position(x), point});
    }
    ++result_.crossings;
  }

  void cut_edges(std::uint32_t old_points) {
    std::ranges::sort(cuts_);
    std::vector<CountedEdge> parts;
    std::size_t next = 0;
    const auto at = [&](std::uint32_t point) { return point < old_points ? merged_.of(point) : point; };
    for (std::uint32_t e = 0; e < result_.edges.size(); ++e) {
      const CountedEdge edge = result_.edges[e];
      std::uint32_t from = edge.ends[0];
      for (; next < cuts_.size() && cuts_[next].edge == e; ++next) {
        parts.push_back({{at(from), at(cuts_[next].point)}, edge.times});
        from = cuts_[next].point;
      }
      parts.push_back({{at(from), at(edge.ends[1])}, edge.times});
    }
    unite(parts);
    result_.edges = std::move(parts);
  }

  const Frame& frame_;
  Arrangement result_;
  std::vector<std::uint32_t> target_;  // by point: the one that stands for it
  DisjointSets merged_;                // of points
  std::vector<std::uint32_t> in_use_;  // by site: the point
  std::vector<Cut> cuts_;
};

}  // namespace

Arrangement arrange(std::vector<Vec2> points, const std::vector<CountedEdge>& edges, const Frame& frame,
                    unsigned threads, const LoopWatch& watch) {
  Arranger arranger(std::move(points), edges, frame);
  for (int round = 0; round < kMostRounds && arranger.round(threads, watch); ++round) {
  }
  arranger.unite_points();
  return std::move(arranger.result());
}

}  // namespace medial_vk::plane
