#include "plane/shapes/close_edges.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "base/point_order.h"
#include "plane/sites/frame.h"

namespace medial_vk::plane {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

constexpr std::size_t kEdgesOfLeaf = 8, kChildren = 4, kLeavesAtATime = 32;
constexpr double kTurnRounding = 0x1p-50;   // of two coordinates within [-1/2, 1/2] in another direction
constexpr std::size_t kMostOverlaps = 256;  // of a leaf with others, in the mean

bool overlap(const Box& a, const Box& b, double gap) {
  return a.lower.x <= b.upper.x + gap && b.lower.x <= a.upper.x + gap && a.lower.y <= b.upper.y + gap &&
         b.lower.y <= a.upper.y + gap;
}

void enlarge(Box& box, const Box& by) {
  box.add(by.lower);
  box.add(by.upper);
}

/// The direction in which most of the length of all segments lies, or across it: by the mean of four times their
/// angles.
Vec2 main_direction(const SiteSet& sites) {
  Vec2 mean;
  for (std::uint32_t site = sites.points(); site < sites.size(); ++site) {
    const Segment& s = sites.segment(site);
    const double cosine = s.along.x * s.along.x - s.along.y * s.along.y, sine = 2 * s.along.x * s.along.y;  // of twice
    mean = mean + s.length * Vec2{cosine * cosine - sine * sine, 2 * cosine * sine};
  }
  const double angle = std::atan2(mean.y, mean.x) / 4;
  return {std::cos(angle), std::sin(angle)};
}

/// Boxes of segments, and of points without segments, in an order along a curve, in groups, groups of groups, and so
/// on. Their sides lie in the main direction of the segments and across it, so that long parallel ones have thin boxes.
class BoxLevels {
 public:
  BoxLevels(const SiteSet& sites, double gap)
      : sites_(sites), gap_(gap), box_gap_(gap + kTurnRounding), direction_(main_direction(sites)) {
    std::vector<std::uint32_t> listed;
    listed.reserve(sites.size());
    for (std::uint32_t site = 0; site < sites.size(); ++site) {
      if (!sites.is_point(site) || sites.segments_of(site).empty()) listed.push_back(site);
    }
    std::vector<Point> middles;
    middles.reserve(listed.size());
    for (const std::uint32_t site : listed) {
      const Vec2 middle = turned(middle_of(site));
      middles.push_back({middle.x, middle.y, 0});
    }
    for (const std::uint32_t i : order_along_curve(middles)) edges_.push_back(listed[i]);
    for (const std::uint32_t edge : edges_) boxes_.push_back(box_of_edge(edge));
    levels_.push_back(grouped(boxes_, kEdgesOfLeaf));
    while (levels_.back().size() > 1) levels_.push_back(grouped(levels_.back(), kChildren));
  }

  std::size_t leaves() const { return levels_.front().size(); }

  /// The leaf itself, and later ones whose boxes overlap its box.
  void find_overlaps(std::size_t leaf, std::vector<std::size_t>& others) const {
    others.clear();
    collect(levels_.size() - 1, 0, leaf, others);
  }

  /// Appends the pairs of an edge of `leaf` with one of these leaves.
  void find_pairs(std::size_t leaf, const std::vector<std::size_t>& others, std::vector<Pair>& pairs) const {
    for (const std::size_t other : others) {
      for (std::size_t i = leaf * kEdgesOfLeaf; i < end_of(leaf); ++i) {
        const std::size_t first = other == leaf ? i + 1 : other * kEdgesOfLeaf;
        for (std::size_t k = first; k < end_of(other); ++k) {
          if (!overlap(boxes_[i], boxes_[k], box_gap_) || are_apart(edges_[i], edges_[k])) continue;
          pairs.emplace_back(std::minmax(edges_[i], edges_[k]));
        }
      }
    }
  }

 private:
  Vec2 turned(Vec2 x) const { return {dot(direction_, x), cross(direction_, x)}; }
  Vec2 middle_of(std::uint32_t site) const {
    if (sites_.is_point(site)) return sites_.point(site);
    const Segment& s = sites_.segment(site);
    return s.begin + (s.length / 2) * s.along;
  }
  std::size_t end_of(std::size_t leaf) const { return std::min((leaf + 1) * kEdgesOfLeaf, edges_.size()); }

  Box box_of_edge(std::uint32_t edge) const {
    Box box;
    if (sites_.is_point(edge)) {
      box.add(turned(sites_.point(edge)));
      return box;
    }
    for (const std::uint32_t end : sites_.segment(edge).ends) box.add(turned(sites_.point(end)));
    return box;
  }

  static std::vector<Box> grouped(const std::vector<Box>& boxes, std::size_t size) {
    std::vector<Box> groups((boxes.size() + size - 1) / size);
    for (std::size_t i = 0; i < boxes.size(); ++i) enlarge(groups[i / size], boxes[i]);
    return groups;
  }

  void collect(std::size_t level, std::size_t node, std::size_t leaf, std::vector<std::size_t>& others) const {
    if (!overlap(levels_[level][node], levels_.front()[leaf], box_gap_)) return;
    if (level == 0) {
      if (node >= leaf) others.push_back(node);
      return;
    }
    const std::size_t end = std::min((node + 1) * kChildren, levels_[level - 1].size());
    for (std::size_t child = node * kChildren; child < end; ++child) {
      collect(level - 1, child, leaf, others);
    }
  }

  bool is_beside(std::uint32_t edge, std::uint32_t line) const {
    if (sites_.is_point(line)) return false;
    const Segment& l = sites_.segment(line);
    if (sites_.is_point(edge)) return std::fabs(l.height(sites_.point(edge), Side::kLeft)) > gap_;
    const Segment& s = sites_.segment(edge);
    const double a = l.height(sites_.point(s.ends[0]), Side::kLeft), b = l.height(sites_.point(s.ends[1]), Side::kLeft);
    return std::min(a, b) > gap_ || std::max(a, b) < -gap_;
  }
  bool are_apart(std::uint32_t a, std::uint32_t b) const { return is_beside(a, b) || is_beside(b, a); }

  const SiteSet& sites_;
  const double gap_, box_gap_;
  const Vec2 direction_;
  std::vector<std::uint32_t> edges_;  // sites: segments, and points without segments
  std::vector<Box> boxes_;
  std::vector<std::vector<Box>> levels_;
};

}  // namespace

std::optional<std::vector<Pair>> close_edges(const SiteSet& sites, double gap, unsigned threads,
                                             const LoopWatch& watch) {
  const BoxLevels levels(sites, gap);
  std::vector<std::vector<Pair>> found((levels.leaves() + kLeavesAtATime - 1) / kLeavesAtATime);
  const std::size_t most = kMostOverlaps * levels.leaves();
  std::atomic<std::size_t> overlaps = 0;
  parallel_blocks(levels.leaves(), kLeavesAtATime, threads, [&](std::size_t begin, std::size_t end) {
    watch.check();
    std::vector<std::size_t> others;
    for (std::size_t leaf = begin; leaf < end && overlaps <= most; ++leaf) {
      levels.find_overlaps(leaf, others);
      overlaps += others.size();
      levels.find_pairs(leaf, others, found[begin / kLeavesAtATime]);
    }
  });
  if (overlaps > most) return {};
  std::vector<Pair> all;
  for (const std::vector<Pair>& part : found) all.insert(all.end(), part.begin(), part.end());
  std::ranges::sort(all);
  return all;
}

}  // namespace medial_vk::plane
