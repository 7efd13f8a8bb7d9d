// The objects of the library that Python holds.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

#include "medial_vk/context.h"
#include "medial_vk/indexed_mesh.h"
#include "native/errors.h"

namespace medial_vk::python {

/// A context that threads of Python share: one at a time uses it.
class SharedContext {
 public:
  explicit SharedContext(Context context) : context_(std::move(context)) {}
  SharedContext(const SharedContext&) = delete;
  SharedContext& operator=(const SharedContext&) = delete;
  /// In a process that was forked off, the driver's threads are missing, and its objects are left as they are.
  ~SharedContext() {
    if (getpid() != process_) new std::optional<Context>(std::move(context_));
  }

  const DeviceDescription& device() const { return context_->device(); }
  /// The process in which it was made, and works.
  bool is_here() const { return getpid() == process_; }

  /// work(context) when no other thread uses the context. Error: kInterrupted.
  template <class Work>
  auto use(const std::stop_token& stop, Work work) -> decltype(work(std::declval<Context&>())) {
    if (!is_here()) {
      return Error{ErrorCode::kUsage,
                   "the context was made in another process, before a fork; make one in this process"};
    }
    std::unique_lock lock(mutex_, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(10))) {
      if (stop.stop_requested()) return Error{ErrorCode::kInterrupted, "stopped while another thread used the context"};
    }
    return work(*context_);
  }

 private:
  pid_t process_ = getpid();
  std::optional<Context> context_;  // always there but in the destructor
  std::timed_mutex mutex_;
};

using ContextHandle = std::shared_ptr<SharedContext>;

/// An immutable mesh with its index. Copies share their data.
struct MeshHandle {
  IndexedMesh mesh;
  std::optional<SideOptions> side = {};  ///< As given to on_side(), if it was.
};

void bind_context(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_analysis(pybind11::module_& module);
void bind_spheres(pybind11::module_& module);
void bind_hulls(pybind11::module_& module);
void bind_unions(pybind11::module_& module);
void bind_distances(pybind11::module_& module);
void bind_following(pybind11::module_& module);
void bind_boundary(pybind11::module_& module);
void bind_plane(pybind11::module_& module);
void bind_plane_axis(pybind11::module_& module);
void bind_sites(pybind11::module_& module);
void bind_any_boundary(pybind11::module_& module);
void bind_part_fits(pybind11::module_& module);
void bind_body_groups(pybind11::module_& module);

}  // namespace medial_vk::python
