#include "plane/diagram/diagram.h"

#include <algorithm>
#include <utility>

#include "plane/diagram/diagram_nodes.h"
#include "plane/diagram/parallel_sort.h"

namespace medial_vk::plane {
namespace {

constexpr std::size_t kLeavesAtATime = 64, kPairsAtATime = 64, kNodesAtATime = 512;

std::vector<std::uint32_t> leaves_of(const CellTree& tree) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t node = 0; node < tree.size(); ++node) {
    if (tree.state(node) == CellState::kLeaf) leaves.push_back(node);
  }
  return leaves;
}

/// Of all leaves, in their order. Progress: half of all, a step for each leaf; the arcs are the other half.
DiagramParts parts_of_leaves(const SiteSet& sites, const DiagramQuery& query, const CellTree& tree,
                             const std::vector<std::uint32_t>& leaves, LoopWatch& watch) {
  std::vector<DiagramParts> found((leaves.size() + kLeavesAtATime - 1) / kLeavesAtATime);
  parallel_blocks(leaves.size(), kLeavesAtATime, query.threads, [&](std::size_t begin, std::size_t end) {
    watch.check();
    LeafDiagram leaf(sites, query);
    for (std::size_t i = begin; i < end; ++i) {
      leaf.find(tree.cell(leaves[i]), found[begin / kLeavesAtATime]);
    }
    watch.finish(end - begin, 2 * leaves.size());
  });
  DiagramParts all;
  for (const DiagramParts& part : found) {
    for (DiagramVertex vertex : part.vertices) {
      vertex.first += static_cast<std::uint32_t>(all.contacts.size());
      all.vertices.push_back(vertex);
    }
    all.contacts.insert(all.contacts.end(), part.contacts.begin(), part.contacts.end());
    all.pairs.insert(all.pairs.end(), part.pairs.begin(), part.pairs.end());
  }
  parallel_sort(all.pairs, query.threads);
  all.pairs.erase(std::unique(all.pairs.begin(), all.pairs.end()), all.pairs.end());
  return all;
}

/// Where an arc can begin or end on its curve.
struct Stop {
  double t = 0;
  std::uint32_t node = kNone;
  NodeKind kind = NodeKind::kThreshold;  // of a new node

  static constexpr std::uint32_t kNone = ~0u;
};

/// An arc whose ends need not be nodes yet.
struct OpenArc {
  ContactPair contacts;
  Bisector curve;
  std::array<Stop, 2> ends;
};

/// The arcs of one bisector. An object is used by one thread.
class ArcsOfPair {
 public:
  ArcsOfPair(const SiteSet& sites, const DiagramQuery& query, const CellTree& tree, DiagramNodes& nodes)
      : sites_(sites), query_(query), tree_(tree), nodes_(nodes) {}

  void find(const ContactPair& pair, std::vector<OpenArc>& arcs) {
    const std::optional<Bisector> curve = bisector_of(sites_, pair[0], pair[1]);
    if (!curve) return;
    collect_stops(pair, *curve);
    for (std::size_t i = 0; i + 1 < stops_.size(); ++i) {
      const Stop &from = stops_[i], &to = stops_[i + 1];
      if (from.node != Stop::kNone && from.node == to.node) continue;
      if (is_part(pair, *curve, (from.t + to.t) / 2)) arcs.push_back({pair, *curve, {from, to}});
    }
  }

 private:
  void collect_stops(const ContactPair& pair, const Bisector& curve) {
    stops_.clear();
    nodes_.find_between(pair, between_);
    for (const std::uint32_t node : between_) {
      stops_.push_back({curve.parameter_of(nodes_.nodes()[node].circle.centre), node});
    }
    const std::size_t at_nodes = stops_.size();
    for (const double angle : {query_.object_angle, query_.deep_angle}) {
      const double reach = curve.reach(angle);
      if (std::isfinite(reach) && reach >= 0) add_ends(reach);
      if (!std::isfinite(query_.radius)) break;
    }
    if (std::isfinite(query_.radius)) add_radius_ends(curve);
    if (query_.wanted != Wanted::kLeft) add_border_ends(curve);
    // A threshold that is reached at a node ends there.
    const auto is_node = [&](const Stop& stop) {
      return std::any_of(stops_.begin(), stops_.begin() + static_cast<std::ptrdiff_t>(at_nodes),
                         [&](const Stop& at) { return std::fabs(stop.t - at.t) <= 64 * tie(curve.radius_at(at.t)); });
    };
    const auto extra = std::remove_if(stops_.begin() + static_cast<std::ptrdiff_t>(at_nodes), stops_.end(), is_node);
    stops_.erase(extra, stops_.end());
    std::ranges::sort(stops_, {}, [](const Stop& stop) { return std::pair(stop.t, stop.node); });
  }

  void add_ends(double reach) {
    stops_.push_back({-reach});
    stops_.push_back({reach});
  }

  void add_radius_ends(const Bisector& curve) {
    const Bisector::Crossings at = curve.with_radius(query_.radius);
    for (int i = 0; i < at.count; ++i) stops_.push_back({at.t[static_cast<std::size_t>(i)]});
  }

  void add_border_ends(const Bisector& curve) {
    for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}}) {
      for (const double side : {-query_.half, query_.half}) {
        const auto at = curve.with_line(axis, dot(axis, query_.centre) + side);
        for (int i = 0; i < at.count; ++i) {
          stops_.push_back({at.t[static_cast<std::size_t>(i)], Stop::kNone, NodeKind::kBorder});
        }
      }
    }
  }

  bool is_part(const ContactPair& pair, const Bisector& curve, double t) const {
    const Circle circle = {curve.at(t), curve.radius_at(t)};
    if (!(circle.radius > 0) || curve.object_angle_at(t) < query_.least_angle(circle.radius)) return false;
    const std::uint32_t node = tree_.node_at(circle.centre);
    if (node == CellTree::kNone || tree_.state(node) == CellState::kDismissed) return false;
    return can_touch(sites_, query_.wanted, pair[0], circle) && can_touch(sites_, query_.wanted, pair[1], circle) &&
           is_empty(sites_, tree_.cell(node).sites, circle);
  }

  const SiteSet& sites_;
  const DiagramQuery& query_;
  const CellTree& tree_;
  DiagramNodes& nodes_;
  std::vector<Stop> stops_;
  std::vector<std::uint32_t> between_;
};

/// Progress: as many steps as the tree has leaves.
std::vector<OpenArc> arcs_of_pairs(const SiteSet& sites, const DiagramQuery& query, const CellTree& tree,
                                   DiagramNodes& nodes, std::span<const ContactPair> pairs, std::size_t leaves,
                                   LoopWatch& watch) {
  std::vector<std::vector<OpenArc>> found((pairs.size() + kPairsAtATime - 1) / kPairsAtATime);
  parallel_blocks(pairs.size(), kPairsAtATime, query.threads, [&](std::size_t begin, std::size_t end) {
    watch.check();
    ArcsOfPair of_pair(sites, query, tree, nodes);
    for (std::size_t i = begin; i < end; ++i) of_pair.find(pairs[i], found[begin / kPairsAtATime]);
    watch.finish(leaves * end / pairs.size() - leaves * begin / pairs.size(), 2 * leaves);
  });
  if (pairs.empty() && leaves > 0) watch.finish(leaves, 2 * leaves);
  std::vector<OpenArc> all;
  for (const std::vector<OpenArc>& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Arcs with nodes at all ends.
void close_arcs(const std::vector<OpenArc>& open, Diagram& diagram) {
  const auto node_at = [&](const OpenArc& arc, const Stop& stop) {
    if (stop.node != Stop::kNone) return stop.node;
    DiagramNode node;
    node.circle = {arc.curve.at(stop.t), arc.curve.radius_at(stop.t)};
    node.object_angle = arc.curve.object_angle_at(stop.t);
    node.kind = stop.kind;
    diagram.nodes.push_back(node);
    return static_cast<std::uint32_t>(diagram.nodes.size() - 1);
  };
  diagram.arcs.reserve(open.size());
  for (const OpenArc& arc : open) {
    const std::uint32_t from = node_at(arc, arc.ends[0]), to = node_at(arc, arc.ends[1]);
    diagram.arcs.push_back({arc.contacts, arc.curve, {from, to}, {arc.ends[0].t, arc.ends[1].t}});
  }
}

/// Where contacts nearly coincide, rounding can accept one arc for several pairs of them. The first is kept.
void drop_copies(std::vector<DiagramArc>& arcs, unsigned threads) {
  using Ends = std::pair<std::uint64_t, std::uint32_t>;  // both nodes in a number, and the arc
  std::vector<Ends> order(arcs.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const auto [least, most] = std::minmax(arcs[i].nodes[0], arcs[i].nodes[1]);
    order[i] = {std::uint64_t{least} << 32 | most, i};
  }
  parallel_sort(order, threads);
  std::vector<bool> is_copy(arcs.size());
  const auto middle = [&](const DiagramArc& arc) { return arc.curve.at((arc.t[0] + arc.t[1]) / 2); };
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (is_copy[order[i].second]) continue;
    const DiagramArc& arc = arcs[order[i].second];
    const double slack = 64 * tie(arc.curve.radius_at(arc.t[0]));
    for (std::size_t k = i + 1; k < order.size() && order[k].first == order[i].first; ++k) {
      if (distance(middle(arc), middle(arcs[order[k].second])) <= slack) is_copy[order[k].second] = true;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (is_copy[i]) continue;
    if (kept != i) arcs[kept] = arcs[i];
    ++kept;
  }
  arcs.erase(arcs.begin() + static_cast<std::ptrdiff_t>(kept), arcs.end());
}

/// A node without arcs is kept if it is salient itself, as the centre of a regular polygon is.
void drop_lone_nodes(const SiteSet& sites, const DiagramQuery& query, const DiagramNodes& found, Diagram& diagram) {
  std::vector<bool> is_end(diagram.nodes.size());
  for (const DiagramArc& arc : diagram.arcs) is_end[arc.nodes[0]] = is_end[arc.nodes[1]] = true;
  parallel_blocks(diagram.nodes.size(), kNodesAtATime, query.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      DiagramNode& node = diagram.nodes[i];
      if (node.kind != NodeKind::kMeeting && node.kind != NodeKind::kCorner) continue;
      const auto contacts = found.contacts_of(static_cast<std::uint32_t>(i));
      node.object_angle = greatest_object_angle(sites, query.wanted, contacts, node.circle.centre);
    }
  });
  std::vector<std::uint32_t> place(diagram.nodes.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < diagram.nodes.size(); ++i) {
    const DiagramNode node = diagram.nodes[i];
    const bool is_salient =
        node.kind == NodeKind::kMeeting && node.object_angle >= query.least_angle(node.circle.radius);
    if (!is_end[i] && !is_salient) continue;
    place[i] = count;
    diagram.nodes[count++] = node;
  }
  diagram.nodes.resize(count);
  for (DiagramArc& arc : diagram.arcs) {
    for (std::uint32_t& node : arc.nodes) node = place[node];
  }
}

}  // namespace

Diagram find_diagram(const SiteSet& sites, const DiagramQuery& query, LoopWatch& watch) {
  const CellTree tree = CellTree::build(sites, query, watch);
  const std::vector<std::uint32_t> leaves = leaves_of(tree);
  const DiagramParts parts = parts_of_leaves(sites, query, tree, leaves, watch);
  DiagramNodes nodes(sites, query, tree, parts);
  const std::vector<OpenArc> open = arcs_of_pairs(sites, query, tree, nodes, parts.pairs, leaves.size(), watch);
  Diagram diagram;
  diagram.nodes = nodes.nodes();
  close_arcs(open, diagram);
  drop_copies(diagram.arcs, query.threads);
  drop_lone_nodes(sites, query, nodes, diagram);
  diagram.cells = tree.size();
  diagram.clustered = nodes.clustered();
  return diagram;
}

}  // namespace medial_vk::plane
