#include "thickness/contact_pool.h"

#include "base/point_ops.h"

namespace medial_vk {

void ContactPool::start(const Point& p, double unit, const Slack& slack) {
  for (const BallContact& contact : met_) {
    if (contacts_.size() < kMost) {
      contacts_.push_back(contact);
      continue;
    }
    contacts_[oldest_] = contact;
    oldest_ = (oldest_ + 1) % kMost;
  }
  met_.clear();
  scale_ = ContactScale(unit, slack);
  blocks_.assign((contacts_.size() + EightContacts::kWidth - 1) / EightContacts::kWidth, {});
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Point at = contacts_[i].at - p;
    scale_.write({at, dot(at, at)}, static_cast<std::uint32_t>(i), blocks_[i / EightContacts::kWidth],
                 i % EightContacts::kWidth);
  }
}

}  // namespace medial_vk
