#include "medial_vk/dynamic_union.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "ball_unions/unions/changing_union.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"

namespace medial_vk {
namespace {

Status check_largest(double largest) {
  if (largest > 0 && std::isfinite(largest)) return {};
  return Error{ErrorCode::kUsage, "`largest` must be positive and finite"};
}

}  // namespace

/// With the errors of arguments that are not valid.
class DynamicUnion::Impl : public ChangingUnion {
 public:
  using ChangingUnion::ChangingUnion;

  /// The error of an invalid ball to be added or moved, if any.
  Status check(const Ball& ball) const {
    if (const Status status = check_balls({&ball, 1}); !status.ok()) return status.error();
    double most = ball.radius;
    for (const double x : ball.centre) most = std::max(most, std::fabs(x));
    if (most > largest()) {
      return Error{ErrorCode::kUsage, "a ball reaches " + std::to_string(most) + ", beyond `largest`, which is " +
                                          std::to_string(largest())};
    }
    return {};
  }
  Status check(std::uint32_t slot) const {
    if (holds(slot)) return {};
    return Error{ErrorCode::kUsage, "no ball in slot " + std::to_string(slot)};
  }
  Status check_room() const {
    if (size() < capacity()) return {};
    return Error{ErrorCode::kUsage, "the union is full: its `capacity` is " + std::to_string(capacity())};
  }
  Status check_settled() const {
    if (!is_shifting()) return {};
    return Error{ErrorCode::kUsage, "after shift(), settle() comes first"};
  }
};

DynamicUnion::DynamicUnion(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DynamicUnion::DynamicUnion(DynamicUnion&&) noexcept = default;
DynamicUnion& DynamicUnion::operator=(DynamicUnion&&) noexcept = default;
DynamicUnion::~DynamicUnion() = default;

Result<DynamicUnion> DynamicUnion::build(std::uint32_t capacity, double largest, unsigned threads) {
  if (capacity >= 1u << 30) return Error{ErrorCode::kUsage, "`capacity` must be below 2^30"};
  if (Status status = check_largest(largest); !status.ok()) return status.error();
  return catch_out_of_memory("making room for balls", [&]() -> Result<DynamicUnion> {
    return DynamicUnion(std::make_unique<Impl>(capacity, largest, threads));
  });
}

std::uint32_t DynamicUnion::slots() const { return impl_->slots(); }
bool DynamicUnion::holds(std::uint32_t slot) const { return impl_->holds(slot); }
std::uint32_t DynamicUnion::size() const { return impl_->size(); }
const Ball& DynamicUnion::ball(std::uint32_t slot) const { return impl_->ball(slot); }
double DynamicUnion::volume() const { return impl_->volume(); }
Exposure DynamicUnion::exposure(std::uint32_t slot) const { return impl_->exposure(slot); }

Result<std::vector<Point>> DynamicUnion::vertices(std::uint32_t slot) const {
  return catch_out_of_memory("finding the vertices of a union", [&]() -> Result<std::vector<Point>> {
    if (Status status = impl_->check_settled(); !status.ok()) return status.error();
    if (Status status = impl_->check(slot); !status.ok()) return status.error();
    return impl_->vertices(slot);
  });
}

std::span<const std::uint32_t> DynamicUnion::changed() const { return impl_->changed(); }
Status DynamicUnion::make_room() {
  return catch_out_of_memory("making room for changes of a union", [&]() -> Status {
    impl_->make_room();
    return {};
  });
}

Status DynamicUnion::clear(double largest) {
  if (Status status = check_largest(largest); !status.ok()) return status;
  impl_->clear(largest);
  return {};
}

Status DynamicUnion::shift(std::uint32_t slot, const Ball& to) {
  if (Status status = impl_->check(slot); !status.ok()) return status;
  if (Status status = impl_->check(to); !status.ok()) return status;
  impl_->shift(slot, to);
  return {};
}

Status DynamicUnion::settle() {
  return catch_out_of_memory("computing what moves of balls have altered", [&]() -> Status {
    impl_->settle();
    return {};
  });
}

Result<Exposure> DynamicUnion::exposure_at(std::uint32_t slot, const Ball& to) {
  return catch_out_of_memory("measuring a ball of a union", [&]() -> Result<Exposure> {
    if (Status status = impl_->check(slot); !status.ok()) return status.error();
    if (Status status = impl_->check(to); !status.ok()) return status.error();
    return impl_->exposure_at(slot, to);
  });
}

void DynamicUnion::undo() { impl_->undo(); }

Result<std::uint32_t> DynamicUnion::add(const Ball& ball) {
  return catch_out_of_memory("adding a ball to a union", [&]() -> Result<std::uint32_t> {
    if (Status status = impl_->check_settled(); !status.ok()) return status.error();
    if (Status status = impl_->check(ball); !status.ok()) return status.error();
    if (Status status = impl_->check_room(); !status.ok()) return status.error();
    return impl_->add(ball);
  });
}

Status DynamicUnion::remove(std::uint32_t slot) {
  return catch_out_of_memory("removing a ball from a union", [&]() -> Status {
    if (Status status = impl_->check_settled(); !status.ok()) return status;
    if (Status status = impl_->check(slot); !status.ok()) return status;
    impl_->remove(slot);
    return {};
  });
}

Status DynamicUnion::move(std::uint32_t slot, const Ball& to) {
  return catch_out_of_memory("moving a ball of a union", [&]() -> Status {
    if (Status status = impl_->check_settled(); !status.ok()) return status;
    if (Status status = impl_->check(slot); !status.ok()) return status;
    if (Status status = impl_->check(to); !status.ok()) return status;
    impl_->move(slot, to);
    return {};
  });
}

Result<double> DynamicUnion::gain(const Ball& ball) {
  return catch_out_of_memory("measuring a ball beside a union", [&]() -> Result<double> {
    if (Status status = impl_->check_settled(); !status.ok()) return status.error();
    if (Status status = impl_->check(ball); !status.ok()) return status.error();
    return impl_->gain(ball);
  });
}

Result<std::vector<double>> DynamicUnion::gains(std::span<const Ball> balls) {
  return catch_out_of_memory("measuring balls beside a union", [&]() -> Result<std::vector<double>> {
    if (Status status = impl_->check_settled(); !status.ok()) return status.error();
    for (const Ball& ball : balls) {
      if (Status status = impl_->check(ball); !status.ok()) return status.error();
    }
    std::vector<double> gains(balls.size());
    impl_->gains(balls, gains);
    return gains;
  });
}

Result<double> DynamicUnion::loss(std::uint32_t slot) {
  return catch_out_of_memory("measuring a union without a ball", [&]() -> Result<double> {
    if (Status status = impl_->check_settled(); !status.ok()) return status.error();
    if (Status status = impl_->check(slot); !status.ok()) return status.error();
    return impl_->loss(slot);
  });
}

}  // namespace medial_vk
