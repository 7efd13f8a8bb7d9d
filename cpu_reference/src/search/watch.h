// The progress of a search, and requests to stop it.
#pragma once

#include <functional>
#include <utility>

namespace medial_vk::reference {

/// Counts finished voxels.
class Watch {
 public:
  /// `report` receives the finished share of `total` voxels and returns false to stop; it may be empty.
  Watch(std::function<bool(double)> report, double total) : report_(std::move(report)), total_(total) {}

  void add(double voxels) { done_ += voxels; }
  void set(double voxels) { done_ = voxels; }
  /// True if stops() has been.
  bool has_stopped() const { return stopped_; }
  /// Reports. Once true, it stays true.
  bool stops() {
    stopped_ = stopped_ || (report_ && !report_(done_ / total_));
    return stopped_;
  }

 private:
  std::function<bool(double)> report_;
  double total_, done_ = 0;
  bool stopped_ = false;
};

}  // namespace medial_vk::reference
