#include "medial_vk/resumable_bounds.h"

#include <algorithm>
#include <optional>

#include "base/host_memory.h"
#include "proximity/body.h"
#include "proximity/resumable/closest_first.h"

namespace medial_vk {

struct ResumableBounds::Impl {
  DistanceBounds bounds;
  std::optional<ClosestFirst> cover, inside;  ///< None: a body has no such balls, or nothing is left to be compared.
  double cover_error = 0, inside_error = 0;   ///< Of a computed separation.

  Impl(const BodyImpl& a, const BodyImpl& b, const Pose& pose) {
    const Placement placement(a, b, pose);
    if (!placement.is_in_range()) return;
    const auto begin = [&](const BodyTree& tree_a, std::span<const Ball> balls_a, const BodyTree& tree_b,
                           std::span<const Ball> balls_b, std::optional<ClosestFirst>& search, double& error) {
      if (tree_a.is_empty() || tree_b.is_empty()) return;
      error = QueryFrame(placement, tree_a.nodes().reach(), tree_b.nodes().reach()).error;
      search.emplace(place_a(tree_a, balls_a, placement), place_b(tree_b, balls_b, placement));
      search->dive();
    };
    begin(a.cover_tree, a.cover, b.cover_tree, b.cover, cover, cover_error);
    begin(a.inside_tree, a.inside, b.inside_tree, b.inside, inside, inside_error);
    if (inside) {
      // Placed balls of b are larger than the true ones by no more than two stretches.
      double largest = 0;
      for (const Ball& ball : b.inside) largest = std::max(largest, ball.radius);
      inside_error += 2 * QueryFrame::kStretch * largest;
    }
    note();
  }

  void step_both(std::uint64_t& left) {
    for (std::optional<ClosestFirst>* search : {&inside, &cover}) {
      if (left == 0 || !*search || (*search)->is_complete()) continue;
      (*search)->step();
      --left;
    }
    note();
  }

  /// Narrows the bounds to what the searches have found, and ends those that can change nothing.
  void note() {
    if (cover) {
      bounds.lower = std::max(bounds.lower, (cover->lower() - cover_error) * (1 - 0x1p-50));
      bounds.cover_pair = cover->balls();
      if (cover->closest() + 2 * cover_error <= 0) end(cover);
    }
    if (inside) {
      bounds.upper = std::min(bounds.upper, std::max(0.0, (inside->closest() + inside_error) * (1 + 0x1p-50)));
      bounds.inside_pair = inside->balls();
      if (bounds.upper == 0) {
        end(inside);
        if (cover) end(cover);
      }
    }
    for (std::optional<ClosestFirst>* search : {&inside, &cover}) {
      if (*search && (*search)->is_complete()) end(*search);
    }
  }

  static void end(std::optional<ClosestFirst>& search) { search.reset(); }
};

ResumableBounds::ResumableBounds(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ResumableBounds::ResumableBounds(ResumableBounds&&) noexcept = default;
ResumableBounds& ResumableBounds::operator=(ResumableBounds&&) noexcept = default;
ResumableBounds::~ResumableBounds() = default;

Result<ResumableBounds> ResumableBounds::create(const Body& a, const Body& b, const Pose& pose) {
  return catch_out_of_memory("beginning a search for bounds", [&]() -> Result<ResumableBounds> {
    return ResumableBounds(std::make_unique<Impl>(Internals::of(a), Internals::of(b), pose));
  });
}

Status ResumableBounds::run(std::uint64_t most_comparisons) {
  return catch_out_of_memory("searching for bounds", [&]() -> Status {
    for (std::uint64_t left = most_comparisons; left > 0 && !is_complete();) impl_->step_both(left);
    return {};
  });
}

const DistanceBounds& ResumableBounds::bounds() const { return impl_->bounds; }
bool ResumableBounds::is_complete() const { return !impl_->cover && !impl_->inside; }

}  // namespace medial_vk
