// Exact arithmetic on doubles: a number is a sum of doubles of which no two overlap (J. R. Shewchuk, "Adaptive
// Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997). Exact unless a product of
// components underflows or overflows; callers keep their numbers between 2^-200 and 2^200.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace medial_vk {

/// Memory for the components of expansions, released all at once.
class ExpansionArena {
 public:
  /// Memory for `count` doubles, valid until reset().
  double* take(std::size_t count) {
    while (block_ < blocks_.size() && used_ + count > blocks_[block_].size) next_block();
    if (block_ == blocks_.size()) add_block(count);
    double* room = blocks_[block_].doubles.get() + used_;
    used_ += count;
    return room;
  }
  /// Releases the last `count` doubles of the latest allocation.
  void give_back(std::size_t count) { used_ -= count; }
  void reset() { block_ = used_ = 0; }
  /// Allocates blocks for so many doubles.
  void make_room(std::size_t count) {
    blocks_.reserve(count / kBlock + 1);
    while (blocks_.size() * kBlock < count) add_block(kBlock);
  }
  /// Allocates what `other` has and this one lacks.
  void make_room_of(const ExpansionArena& other) {
    while (blocks_.size() < other.blocks_.size()) add_block(other.blocks_[blocks_.size()].size);
  }

 private:
  struct Block {
    std::unique_ptr<double[]> doubles;
    std::size_t size;
  };
  void next_block() {
    ++block_;
    used_ = 0;
  }
  void add_block(std::size_t count) {
    const std::size_t size = count > kBlock ? count : kBlock;
    blocks_.push_back({std::make_unique_for_overwrite<double[]>(size), size});
  }

  static constexpr std::size_t kBlock = 4096;
  std::vector<Block> blocks_;
  std::size_t block_ = 0, used_ = 0;
};

/// A number, exactly: the sum of its components, which do not overlap, the smallest first, none of them zero. The empty
/// sum is zero. The components lie in an arena.
using Expansion = std::span<const double>;

/// -1, 0 or 1: the largest component outweighs all others.
inline int sign(Expansion e) { return e.empty() ? 0 : e.back() > 0 ? 1 : -1; }

/// The rounded value, with an error below two units in its last place, since each component is smaller than the next.
inline double value(Expansion e) {
  double sum = 0;
  for (const double component : e) sum += component;
  return sum;
}

/// Sums, differences and products of expansions, exactly. The results are valid until the arena is reset.
class ExpansionMath {
 public:
  explicit ExpansionMath(ExpansionArena& arena) : arena_(&arena) {}

  Expansion number(double a);
  Expansion difference(double a, double b);
  Expansion square(double a);
  Expansion sum(Expansion e, Expansion f) { return combine(e, f, 1); }
  Expansion difference(Expansion e, Expansion f) { return combine(e, f, -1); }
  Expansion product(Expansion e, Expansion f);
  /// The same number in as few components as its bits require, up to a few.
  Expansion compressed(Expansion e);

 private:
  Expansion pair(double high, double low);
  Expansion combine(Expansion e, Expansion f, double sign_of_f);
  Expansion scale(Expansion e, double b);

  ExpansionArena* arena_;
};

}  // namespace medial_vk
