// The part of a Voronoi diagram in a cell with few sites: its vertices, and the pairs of contacts whose bisector bounds
// their regions there.
#pragma once

#include <span>
#include <vector>

#include "plane/diagram/leaf_contacts.h"
#include "plane/sites/equidistant.h"

namespace medial_vk::plane {

/// Three contacts or more are equally far from it.
struct DiagramVertex {
  Circle circle;
  std::uint32_t first = 0, count = 0;  // of its contacts, sorted
};

using ContactPair = std::array<Contact, 2>;  // sorted

struct DiagramParts {
  std::vector<DiagramVertex> vertices;
  std::vector<Contact> contacts;
  std::vector<ContactPair> pairs;  ///< Whose bisector crosses the border of a cell or meets a vertex.

  std::span<const Contact> contacts_of(const DiagramVertex& vertex) const {
    return std::span(contacts).subspan(vertex.first, vertex.count);
  }
};

/// Whether points between these contacts are wanted, whatever their object angle.
bool can_pair(const SiteSet& sites, Wanted wanted, Contact a, Contact b);

/// Half the greatest angle between directions to contacts that can pair, from a point that is equally far from all.
double greatest_object_angle(const SiteSet& sites, Wanted wanted, std::span<const Contact> contacts, Vec2 x);

/// Whether the circle touches the contact, on a side that is wanted, up to rounding.
bool can_touch(const SiteSet& sites, Wanted wanted, Contact contact, const Circle& circle);
/// Whether none of the sites lies inside of the circle, beyond rounding.
bool is_empty(const SiteSet& sites, std::span<const std::uint32_t> list, const Circle& circle);

/// An object is used by one thread.
class LeafDiagram {
 public:
  LeafDiagram(const SiteSet& sites, const DiagramQuery& query)
      : sites_(sites), query_(query), contacts_(sites, query.wanted) {}

  /// Appends to `parts` what lies in the cell.
  void find(const Cell& cell, DiagramParts& parts);

 private:
  void set_sides(const Cell& cell);
  void find_vertices(const Cell& cell, DiagramParts& parts);
  void try_circles(const Cell& cell, const std::array<Contact, 3>& three, DiagramParts& parts);
  bool can_become_vertex(const Cell& cell, const Circle& rough) const;
  void add_vertex(const Circle& circle, DiagramParts& parts);
  void add_pair(Contact a, Contact b, DiagramParts& parts) const;
  bool excludes(Contact a, Contact b) const;
  void find_crossing_pairs(const Cell& cell, DiagramParts& parts);
  bool is_crossed(const Cell& cell, Contact a, Contact b, const Bisector& curve) const;
  bool is_in_cell(const Cell& cell, const Circle& circle) const;
  bool touches(Contact contact, const Circle& circle) const {
    return can_touch(sites_, query_.wanted, contact, circle);
  }

  const SiteSet& sites_;
  const DiagramQuery& query_;
  LeafContacts contacts_;
  std::vector<Line> sides_;  // of the cell, which is on the left of each
  std::vector<Contact> touching_;
  std::vector<Circle> circles_;  // of the cell
};

}  // namespace medial_vk::plane
