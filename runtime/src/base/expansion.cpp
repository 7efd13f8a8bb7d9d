#include "base/expansion.h"

#include <utility>

#include "base/double_double.h"

namespace medial_vk {
namespace {

/// Appends components to an expansion, without zeros.
struct Writer {
  double* begin;
  std::size_t count = 0;
  void put(double component) {
    if (component != 0) begin[count++] = component;
  }
};

}  // namespace

Expansion ExpansionMath::pair(double high, double low) {
  Writer out{arena_->take(2)};
  out.put(low);
  out.put(high);
  arena_->give_back(2 - out.count);
  return {out.begin, out.count};
}

Expansion ExpansionMath::number(double a) { return pair(a, 0); }

Expansion ExpansionMath::difference(double a, double b) {
  const auto [high, low] = two_sum(a, -b);
  return pair(high, low);
}

Expansion ExpansionMath::square(double a) {
  const auto [high, low] = two_product(a, a);
  return pair(high, low);
}

/// Merges by magnitude and adds up, carrying the rounding of each sum (Shewchuk, theorem 13).
Expansion ExpansionMath::combine(Expansion e, Expansion f, double sign_of_f) {
  const std::size_t room = e.size() + f.size();
  Writer out{arena_->take(room)};
  std::size_t i = 0, j = 0;
  double carried = 0;
  bool first = true;
  while (i < e.size() || j < f.size()) {
    const bool from_e = j == f.size() || (i < e.size() && std::fabs(e[i]) < std::fabs(f[j]));
    const double next = from_e ? e[i++] : sign_of_f * f[j++];
    if (first) {
      carried = next;
      first = false;
      continue;
    }
    const auto [high, low] = two_sum(carried, next);
    out.put(low);
    carried = high;
  }
  out.put(carried);
  arena_->give_back(room - out.count);
  return {out.begin, out.count};
}

/// Shewchuk, theorem 19.
Expansion ExpansionMath::scale(Expansion e, double b) {
  if (e.empty()) return {};
  const std::size_t room = 2 * e.size();
  Writer out{arena_->take(room)};
  auto [carried, first_low] = two_product(e[0], b);
  out.put(first_low);
  for (std::size_t i = 1; i < e.size(); ++i) {
    const auto [high, low] = two_product(e[i], b);
    const auto [middle, least] = two_sum(carried, low);
    out.put(least);
    const auto [top, rest] = fast_two_sum(high, middle);
    out.put(rest);
    carried = top;
  }
  out.put(carried);
  arena_->give_back(room - out.count);
  return {out.begin, out.count};
}

Expansion ExpansionMath::product(Expansion e, Expansion f) {
  if (e.size() < f.size()) std::swap(e, f);
  if (f.empty()) return {};
  Expansion sum_so_far = scale(e, f[0]);
  for (std::size_t k = 1; k < f.size(); ++k) sum_so_far = sum(sum_so_far, scale(e, f[k]));
  return sum_so_far;
}

/// Shewchuk, theorem 23: sums from the largest component down, then from the smallest up.
Expansion ExpansionMath::compressed(Expansion e) {
  if (e.size() < 2) return e;
  const std::size_t size = e.size();
  double* const out = arena_->take(size);
  double carried = e.back();
  std::size_t bottom = size - 1;
  for (std::size_t i = size - 1; i-- > 0;) {
    const auto [high, low] = fast_two_sum(carried, e[i]);
    if (low == 0) {
      carried = high;
    } else {
      out[bottom--] = high;
      carried = low;
    }
  }
  out[bottom] = carried;
  std::size_t top = 0;
  for (std::size_t i = bottom + 1; i < size; ++i) {
    const auto [high, low] = fast_two_sum(out[i], carried);
    if (low != 0) out[top++] = low;
    carried = high;
  }
  if (carried != 0) out[top++] = carried;
  return {out, top};
}

}  // namespace medial_vk
