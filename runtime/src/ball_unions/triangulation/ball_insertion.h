// The incremental construction of a regular triangulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ball_unions/triangulation/bisector.h"
#include "ball_unions/triangulation/regular_triangulation.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// Adds ball after ball: the tetrahedra whose orthogonal sphere is too near to the new ball are removed, and the cavity
/// is filled with tetrahedra from its faces to the new ball (A. Bowyer; D. F. Watson, 1981; with weights: H.
/// Edelsbrunner, N. R. Shah, "Incremental Topological Flipping Works for Regular Triangulations", 1996). Its memory
/// serves one triangulation after the other.
class BallInsertion {
 public:
  using Tetrahedron = RegularTriangulation::Tetrahedron;

  BallInsertion() : exact_({}, no_walls_) {}
  BallInsertion(const BallInsertion&) = delete;
  BallInsertion& operator=(const BallInsertion&) = delete;

  /// So that a triangulation of so many balls allocates nothing.
  void make_room(std::size_t balls);
  /// One tetrahedron that holds all later centres. The balls stay where they are until take().
  void start(std::span<const Ball> balls, const std::array<std::uint32_t, 4>& corners);
  void insert(std::uint32_t ball);
  std::size_t size() const { return tetrahedra_.size() - free_.size(); }
  /// The tetrahedra that are left, without gaps.
  void take(std::vector<Tetrahedron>& result);

 private:
  static constexpr std::uint32_t kNone = RegularTriangulation::kNone;

  /// The faces of a cavity meet in edges, two in each: an edge is inserted here at its first face, and found at its
  /// second.
  class CavityEdges {
   public:
    void make_room(std::size_t edges);
    struct Side {
      std::uint32_t tetrahedron, face;
    };
    void start(std::size_t edges);
    /// The side that was inserted for this edge; if there is none, inserts `side`.
    const Side* meet(std::uint32_t a, std::uint32_t b, Side side);

   private:
    struct Slot {
      std::uint64_t key;
      Side side;
      std::uint32_t stamp;
    };
    std::vector<Slot> slots_;
    std::size_t mask_ = 0;  // of the present cavity, one less than a power of two
    std::uint32_t stamp_ = 0;
  };

  /// A face of the cavity, as the tetrahedron from it to the new ball.
  struct Face {
    std::array<std::uint32_t, 4> balls;
    std::uint32_t own;      // which of them is the new one
    std::uint32_t outside;  // the tetrahedron on the other side,
    std::uint32_t back;     // and which of its neighbours is on this one
  };

  int side_of_face(const Tetrahedron& t, std::size_t k, std::uint32_t ball);
  std::uint32_t locate(std::uint32_t ball);
  bool conflicts(std::uint32_t t, std::uint32_t ball);
  bool is_marked(std::uint32_t t) const { return marks_[t] / 2 == stamp_; }
  void mark(std::uint32_t t, bool in_cavity) { marks_[t] = 2 * stamp_ + (in_cavity ? 1 : 0); }
  bool is_in_cavity(std::uint32_t t) const { return marks_[t] == 2 * stamp_ + 1; }
  void find_cavity(std::uint32_t first, std::uint32_t ball);
  void add_face(std::uint32_t t, std::uint32_t k, std::uint32_t ball);
  std::uint32_t room_for(std::size_t n);
  void fill_cavity();
  void join(std::uint32_t t, std::uint32_t k, const Face& face);

  std::span<const Ball> balls_;
  std::vector<Wall> no_walls_;
  ExactSide exact_;
  std::vector<Tetrahedron> tetrahedra_;
  // by tetrahedron: twice the number of the last insertion that tested it; 1 more: in its cavity
  std::vector<std::uint32_t> marks_;
  std::vector<std::uint32_t> free_;
  std::uint32_t last_ = 0, stamp_ = 0;

  // State of the current insertion.
  std::vector<std::uint32_t> cavity_;
  std::vector<Face> faces_;
  CavityEdges edges_;
};

}  // namespace medial_vk
