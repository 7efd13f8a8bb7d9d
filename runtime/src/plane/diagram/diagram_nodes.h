// The nodes of a diagram: vertices of its cells, corners of the boundary, and cells that were not divided further, with
// those that coincide taken as one.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "plane/diagram/diagram.h"

namespace medial_vk::plane {

class DiagramNodes {
 public:
  DiagramNodes(const SiteSet& sites, const DiagramQuery& query, const CellTree& tree, const DiagramParts& parts);

  std::vector<DiagramNode>& nodes() { return nodes_; }
  double clustered() const { return clustered_; }
  /// Of a node, sorted.
  std::span<const Contact> contacts_of(std::uint32_t node) const {
    return std::span(contacts_).subspan(first_[node], first_[node + 1] - first_[node]);
  }
  /// Sets `found` to the nodes that touch both, in their order. Any thread.
  void find_between(const ContactPair& pair, std::vector<std::uint32_t>& found) const;

 private:
  void add_vertices(const DiagramParts& parts);
  void add_corners(const DiagramQuery& query, const CellTree& tree);
  void add_clusters(const CellTree& tree);
  void add(const DiagramNode& node, std::span<const Contact> contacts);
  void merge(const CellTree& tree);
  void join_coincident();
  void join_near_clusters();
  void join_clusters(const CellTree& tree);
  void keep_roots();
  void join_contacts(const std::vector<std::uint32_t>& place, std::size_t count);
  void index_contacts();
  std::span<const std::uint32_t> nodes_at(Contact contact) const;

  const SiteSet& sites_;
  Wanted wanted_;
  unsigned threads_;
  std::vector<DiagramNode> nodes_;
  std::vector<std::size_t> first_;  // of a node's contacts, and the end of the last
  std::vector<Contact> contacts_;
  DisjointSets same_;
  std::vector<std::uint32_t> cluster_cells_;
  std::uint32_t first_cluster_ = 0;
  double clustered_ = 0;
  std::vector<std::size_t> first_node_;  // by number of a contact
  std::vector<std::uint32_t> nodes_of_;  // ascending for each contact
};

}  // namespace medial_vk::plane
