#include "plane/shapes/meetings.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "plane/diagram/cell_tree.h"
#include "plane/shapes/close_edges.h"
#include "plane/shapes/orientation.h"

namespace medial_vk::plane {
namespace {

class Meetings {
 public:
  Meetings(const SiteSet& sites, unsigned threads, const LoopWatch& watch) : sites_(sites) {
    if (const auto pairs = close_edges(sites, 2 * kSnap, threads, watch)) {
      for (const auto& [a, b] : *pairs) add_with_ends(a, b);
    } else {
      add_from_cells(threads, watch);
    }
    std::ranges::sort(all_);
    all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
  }

  std::vector<Meeting> take() { return std::move(all_); }

 private:
  void add_with_ends(std::uint32_t a, std::uint32_t b) {
    std::array<std::uint32_t, 6> list = {};
    std::size_t size = 0;
    for (const std::uint32_t site : {a, b}) {
      list[size++] = site;
      if (sites_.is_point(site)) continue;
      for (const std::uint32_t end : sites_.segment(site).ends) list[size++] = end;
    }
    add(std::span(list).first(size));
  }

  /// Sites that meet are both nearest where they do.
  void add_from_cells(unsigned threads, const LoopWatch& watch) {
    DiagramQuery query;
    query.wanted = Wanted::kBothSides;
    query.object_angle = 2;  // above every angle: cells without boundary are dismissed
    query.slack = 2 * kSnap;
    query.threads = threads;
    const CellTree tree = CellTree::build(sites_, query, watch);
    for (std::uint32_t node = 0; node < tree.size(); ++node) {
      if (tree.state(node) == CellState::kLeaf || tree.state(node) == CellState::kClustered) add(tree.cell(node).sites);
    }
  }

  void add(std::span<const std::uint32_t> list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (std::size_t k = i + 1; k < list.size(); ++k) {
        const std::uint32_t a = std::min(list[i], list[k]), b = std::max(list[i], list[k]);
        if (a != b && meet(a, b)) all_.push_back({a, b});
      }
    }
  }

  bool meet(std::uint32_t a, std::uint32_t b) const {
    if (sites_.are_joined(a, b)) return false;
    if (sites_.is_point(b)) return distance(sites_.point(a), sites_.point(b)) <= 2 * kSnap;
    if (sites_.is_point(a)) return sites_.distance_to(b, sites_.point(a)) <= kSnap;
    return cross(sites_.segment(a).ends, sites_.segment(b).ends);
  }

  /// In a point that is an end of neither.
  bool cross(const std::array<std::uint32_t, 2>& a, const std::array<std::uint32_t, 2>& b) const {
    for (const std::uint32_t end : a) {
      if (end == b[0] || end == b[1]) return false;
    }
    const Vec2 p = sites_.point(a[0]), q = sites_.point(a[1]), r = sites_.point(b[0]), s = sites_.point(b[1]);
    return orientation(p, q, r) * orientation(p, q, s) < 0 && orientation(r, s, p) * orientation(r, s, q) < 0;
  }

  const SiteSet& sites_;
  std::vector<Meeting> all_;
};

}  // namespace

std::vector<Meeting> find_meetings(const SiteSet& sites, unsigned threads, const LoopWatch& watch) {
  return Meetings(sites, threads, watch).take();
}

}  // namespace medial_vk::plane
