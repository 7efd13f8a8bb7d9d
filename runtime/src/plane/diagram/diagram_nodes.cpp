#include "plane/diagram/diagram_nodes.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "plane/diagram/parallel_sort.h"

namespace medial_vk::plane {
namespace {

constexpr double kGrid = 0x1p-35;

/// Nodes at this distance or less are one: each was accepted with a slack of tie() in three distances, which moves a
/// centre by more where contacts lie at small angles.
constexpr double merge_distance(double radius) { return 64 * tie(radius); }
static_assert(merge_distance(1.5) < kGrid);

/// Within this distance of it the centre of a circle through three neighbouring sides of a regular polygon is found, up
/// to some thousand sides: two neighbours differ by tie() where the centre has moved by tie() over the square of their
/// turn.
constexpr double kNearCluster = 0x1p-30;

struct GridKey {
  std::int64_t x, y;
  std::uint32_t node;
  auto operator<=>(const GridKey&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
};

GridKey key_of(Vec2 x, std::uint32_t node) {
  return {static_cast<std::int64_t>(std::floor(x.x / kGrid)), static_cast<std::int64_t>(std::floor(x.y / kGrid)), node};
}

std::size_t number_of(Contact contact) { return 2 * std::size_t{contact.site} + (contact.side == Side::kLeft ? 0 : 1); }

}  // namespace

DiagramNodes::DiagramNodes(const SiteSet& sites, const DiagramQuery& query, const CellTree& tree,
                           const DiagramParts& parts)
    : sites_(sites), wanted_(query.wanted), threads_(query.threads) {
  add_vertices(parts);
  add_corners(query, tree);
  add_clusters(tree);
  merge(tree);
  index_contacts();
}

void DiagramNodes::add(const DiagramNode& node, std::span<const Contact> contacts) {
  nodes_.push_back(node);
  first_.push_back(contacts_.size());
  contacts_.insert(contacts_.end(), contacts.begin(), contacts.end());
}

void DiagramNodes::add_vertices(const DiagramParts& parts) {
  for (const DiagramVertex& vertex : parts.vertices) {
    add({vertex.circle, 0, NodeKind::kMeeting}, parts.contacts_of(vertex));
  }
}

/// Two segments that leave a point, with less than half a turn between them, meet in a corner of the region between.
void DiagramNodes::add_corners(const DiagramQuery& query, const CellTree& tree) {
  for (std::uint32_t p = 0; p < sites_.points(); ++p) {
    const std::span<const std::uint32_t> fan = sites_.segments_of(p);
    if (fan.size() < 2 || tree.node_at(sites_.point(p)) == CellTree::kNone) continue;
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const std::uint32_t right = fan[i], left = fan[(i + 1) % fan.size()];
      const Vec2 from = sites_.leaving(p, right), to = sites_.leaving(p, left);
      if (!(cross(from, to) > 0)) continue;
      const auto side_towards = [&](std::uint32_t segment, Side when_leaving) {
        return sites_.segment(segment).ends[0] == p ? when_leaving : other(when_leaving);
      };
      std::array<Contact, 2> pair = {Contact{right, side_towards(right, Side::kLeft)},
                                     Contact{left, side_towards(left, Side::kRight)}};
      if (!allows(query.wanted, pair[0].side) || !can_pair(sites_, query.wanted, pair[0], pair[1])) continue;
      if ((std::numbers::pi - angle_between(from, to)) / 2 < query.object_angle) continue;
      std::ranges::sort(pair);
      add({{sites_.point(p), 0}, 0, NodeKind::kCorner}, pair);
    }
  }
}

void DiagramNodes::add_clusters(const CellTree& tree) {
  first_cluster_ = static_cast<std::uint32_t>(nodes_.size());
  std::vector<Contact> contacts;
  for (std::uint32_t cluster = 0; cluster < tree.size(); ++cluster) {
    if (tree.state(cluster) != CellState::kClustered) continue;
    const Cell cell = tree.cell(cluster);
    contacts.clear();
    double radius = 2;
    for (const std::uint32_t site : cell.sites) {
      radius = std::min(radius, sites_.distance_to(site, cell.centre));
      for (const Side side : {Side::kLeft, Side::kRight}) {
        if (sites_.is_point(site) ? side == Side::kLeft : allows(wanted_, side)) contacts.push_back({site, side});
      }
    }
    std::ranges::sort(contacts);
    add({{cell.centre, radius}, 0, NodeKind::kMeeting}, contacts);
    cluster_cells_.push_back(cluster);
    clustered_ = std::max(clustered_, 2 * (cell.reach + kNearCluster));
  }
}

void DiagramNodes::merge(const CellTree& tree) {
  same_.reset(nodes_.size());
  join_coincident();
  join_clusters(tree);
  keep_roots();
}

void DiagramNodes::join_coincident() {
  std::vector<GridKey> keys;
  keys.reserve(nodes_.size());
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) keys.push_back(key_of(nodes_[i].circle.centre, i));
  parallel_sort(keys, threads_);
  // Later keys up to one cell away: those of the same column follow, those of the next one are kept track of.
  std::size_t ahead = 0;
  const auto join_near = [&](const GridKey& key, std::size_t from, std::int64_t x) {
    for (; from < keys.size() && keys[from].x == x && keys[from].y <= key.y + 1; ++from) {
      const Circle &a = nodes_[key.node].circle, &b = nodes_[keys[from].node].circle;
      if (distance(a.centre, b.centre) <= merge_distance(std::max(a.radius, b.radius)))
        same_.join(key.node, keys[from].node);
    }
  };
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const GridKey &key = keys[i], next = {key.x + 1, key.y - 1, 0};
    while (ahead < keys.size() && keys[ahead] < next) ++ahead;
    join_near(key, i + 1, key.x);
    join_near(key, ahead, key.x + 1);
  }
}

/// Nodes near a cluster belong to it: where contacts are neighbours, as sides of a regular polygon, rounding moves the
/// circles through them farther than others.
void DiagramNodes::join_near_clusters() {
  std::vector<std::pair<double, std::uint32_t>> clusters;
  for (std::uint32_t i = first_cluster_; i < nodes_.size(); ++i) clusters.emplace_back(nodes_[i].circle.centre.x, i);
  std::ranges::sort(clusters);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const Vec2 centre = nodes_[i].circle.centre;
    auto at = std::ranges::lower_bound(clusters, std::pair(centre.x - kNearCluster, std::uint32_t{0}));
    for (; at != clusters.end() && at->first <= centre.x + kNearCluster; ++at) {
      if (distance(nodes_[at->second].circle.centre, centre) <= kNearCluster) same_.join(i, at->second);
    }
  }
}

/// Cells that touch, and vertices within or beside them.
void DiagramNodes::join_clusters(const CellTree& tree) {
  if (cluster_cells_.empty()) return;
  join_near_clusters();
  const auto join_at = [&](std::uint32_t node, Vec2 x) {
    const auto at = std::ranges::lower_bound(cluster_cells_, tree.node_at(x));
    if (at == cluster_cells_.end() || *at != tree.node_at(x)) return;
    same_.join(node, first_cluster_ + static_cast<std::uint32_t>(at - cluster_cells_.begin()));
  };
  for (std::uint32_t i = 0; i < cluster_cells_.size(); ++i) {
    const Cell cell = tree.cell(cluster_cells_[i]);
    for (std::size_t k = 0; k < cell.corners.size(); ++k) {
      const Vec2 corner = cell.corners[k], middle = 0.5 * (corner + cell.corners[(k + 1) % cell.corners.size()]);
      for (const Vec2 x : {corner, middle}) join_at(first_cluster_ + i, x + 0.25 * (x - cell.centre));
    }
  }
  for (std::uint32_t i = 0; i < first_cluster_; ++i) {
    const double step = merge_distance(nodes_[i].circle.radius);
    for (const Vec2 way : {Vec2{0, 0}, Vec2{step, 0}, Vec2{-step, 0}, Vec2{0, step}, Vec2{0, -step}}) {
      join_at(i, nodes_[i].circle.centre + way);
    }
  }
}

void DiagramNodes::keep_roots() {
  std::vector<std::uint32_t> place(nodes_.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const std::uint32_t root = same_.of(i);
    place[i] = root == i ? count : place[root];  // roots come first
    if (root == i) nodes_[count++] = nodes_[i];
  }
  nodes_.resize(count);
  join_contacts(place, count);
}

/// Those of all nodes that became one, sorted, each once.
void DiagramNodes::join_contacts(const std::vector<std::uint32_t>& place, std::size_t count) {
  first_.push_back(contacts_.size());
  std::vector<std::size_t> next(count + 1);
  for (std::size_t i = 0; i < place.size(); ++i) next[place[i] + 1] += first_[i + 1] - first_[i];
  for (std::size_t i = 0; i < count; ++i) next[i + 1] += next[i];
  std::vector<std::size_t> begins = next;
  std::vector<Contact> joined(contacts_.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) joined[next[place[i]]++] = contacts_[k];
  }
  first_.assign(1, 0);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto begin = joined.begin() + static_cast<std::ptrdiff_t>(begins[i]);
    const auto end = joined.begin() + static_cast<std::ptrdiff_t>(begins[i + 1]);
    std::sort(begin, end);
    const auto out = joined.begin() + static_cast<std::ptrdiff_t>(kept);
    kept += static_cast<std::size_t>(std::copy(begin, std::unique(begin, end), out) - out);
    first_.push_back(kept);
  }
  joined.resize(kept);
  contacts_ = std::move(joined);
}

void DiagramNodes::index_contacts() {
  first_node_.assign(2 * std::size_t{sites_.size()} + 1, 0);
  for (const Contact contact : contacts_) ++first_node_[number_of(contact) + 1];
  for (std::size_t i = 1; i < first_node_.size(); ++i) first_node_[i] += first_node_[i - 1];
  std::vector<std::size_t> next(first_node_.begin(), first_node_.end() - 1);
  nodes_of_.resize(contacts_.size());
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    for (const Contact contact : contacts_of(node)) nodes_of_[next[number_of(contact)]++] = node;
  }
}

std::span<const std::uint32_t> DiagramNodes::nodes_at(Contact contact) const {
  const std::size_t i = number_of(contact);
  return std::span(nodes_of_).subspan(first_node_[i], first_node_[i + 1] - first_node_[i]);
}

void DiagramNodes::find_between(const ContactPair& pair, std::vector<std::uint32_t>& found) const {
  auto fewer = nodes_at(pair[0]), more = nodes_at(pair[1]);
  if (fewer.size() > more.size()) std::swap(fewer, more);
  found.clear();
  for (const std::uint32_t node : fewer) {
    if (std::ranges::binary_search(more, node)) found.push_back(node);
  }
}

}  // namespace medial_vk::plane
