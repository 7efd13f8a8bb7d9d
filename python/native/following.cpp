#include <pybind11/stl.h>
#include <unistd.h>

#include <mutex>

#include "medial_vk/cover_follower.h"
#include "medial_vk/follower.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// A follower for threads of Python, one at a time. Its worker threads are missing in a process that was forked off,
/// where it is left as it is.
template <class F>
class SharedFollower {
 public:
  explicit SharedFollower(F of) : follower_(std::make_unique<F>(std::move(of))) {}
  SharedFollower(const SharedFollower&) = delete;
  SharedFollower& operator=(const SharedFollower&) = delete;
  ~SharedFollower() {
    if (getpid() != process_) static_cast<void>(follower_.release());
  }

  template <class Work>
  auto use(const Work& work) -> decltype(work(std::declval<F&>())) {
    if (getpid() != process_) {
      return Error{ErrorCode::kUsage,
                   "the follower was made in another process, before a fork; make one in this process"};
    }
    const std::lock_guard lock(mutex_);
    return work(*follower_);
  }

 private:
  pid_t process_ = getpid();
  std::unique_ptr<F> follower_;
  std::mutex mutex_;
};

/// work(follower) on a thread of its own, so that signals are handled; after one, the frame is still computed.
template <class F, class Work>
auto use(const std::shared_ptr<SharedFollower<F>>& shared, Work work) {
  return run([shared, work = std::move(work)] { return shared->use(work); });
}

using Inside = SharedFollower<Follower>;
using Cover = SharedFollower<CoverFollower>;

FollowerOptions follower_options(py::dict values) {
  FollowerOptions made;
  Options options(std::move(values));
  options.read("rule", made.rule,
               std::array{Choice<FollowRule>{"tangent", FollowRule::kTangent},
                          Choice<FollowRule>{"published", FollowRule::kPublished}});
  options.read("steps", made.steps);
  options.read("protrusion", made.protrusion);
  options.read("shrunk", made.shrunk);
  options.read("object_angle", made.object_angle);
  options.read("renewed", made.renewed);
  options.read("renewal_factor", made.renewal_factor);
  options.read("threads", made.threads);
  options.finish();
  return made;
}

std::shared_ptr<Inside> make_inside(const MeshHandle& rest, py::handle centres, py::handle radii, py::dict values) {
  const FollowerOptions options = follower_options(std::move(values));
  return value_of(run([rest, balls = balls_of(centres, radii), options]() -> Result<std::shared_ptr<Inside>> {
    Result<Follower> made = Follower::create(rest.mesh, balls, options);
    if (!made) return made.error();
    return std::make_shared<Inside>(std::move(made).value());
  }));
}

std::shared_ptr<Cover> make_cover(const MeshHandle& rest, py::handle centres, py::handle radii, py::dict values) {
  CoverFollowerOptions made;
  Options options(std::move(values));
  options.read("surface_only", made.surface_only);
  options.read("steps", made.steps);
  options.read("threads", made.threads);
  options.finish();
  return value_of(run([rest, balls = balls_of(centres, radii), made]() -> Result<std::shared_ptr<Cover>> {
    Result<CoverFollower> follower = CoverFollower::create(rest.mesh, balls, made);
    if (!follower) return follower.error();
    return std::make_shared<Cover>(std::move(follower).value());
  }));
}

/// The balls of a frame, copied while no other thread can go on to the next one.
struct Frame {
  std::vector<Ball> balls;
  std::vector<std::uint8_t> states, origins;
};

Frame frame_of(const Follower& follower) {
  Frame frame;
  frame.balls.assign(follower.balls().begin(), follower.balls().end());
  frame.states.reserve(frame.balls.size());
  frame.origins.reserve(frame.balls.size());
  for (const FollowState state : follower.states()) frame.states.push_back(static_cast<std::uint8_t>(state));
  for (const FollowOrigin origin : follower.origins()) frame.origins.push_back(static_cast<std::uint8_t>(origin));
  return frame;
}

Frame frame_of(const CoverFollower& follower) {
  Frame frame;
  frame.balls.assign(follower.balls().begin(), follower.balls().end());
  return frame;
}

py::dict frame_dict(Frame frame) {
  py::dict out = balls_dict(frame.balls);
  out["states"] = array_of(std::move(frame.states));
  out["origins"] = array_of(std::move(frame.origins));
  return out;
}

template <class F>
py::dict update(const std::shared_ptr<SharedFollower<F>>& shared, py::handle array) {
  return frame_dict(value_of(use(shared, [vertices = points_of(array, "vertices")](F& follower) -> Result<Frame> {
    Status status = follower.update(vertices);
    if (!status) return status.error();
    return frame_of(follower);
  })));
}

template <class F>
py::dict present(const std::shared_ptr<SharedFollower<F>>& shared) {
  return frame_dict(value_of(use(shared, [](F& follower) -> Result<Frame> { return frame_of(follower); })));
}

template <class F>
void reset(const std::shared_ptr<SharedFollower<F>>& shared) {
  require(use(shared, [](F& follower) { return follower.reset(); }));
}

py::dict measure_inside(const std::shared_ptr<Inside>& shared) {
  const FollowMeasures measures = value_of(use(shared, [](Follower& follower) { return follower.measure(); }));
  py::dict out;
  out["solid_volume"] = measures.solid_volume;
  out["ball_volume"] = measures.ball_volume;
  out["outside_bound"] = measures.outside_bound;
  return out;
}

py::dict measure_cover(const std::shared_ptr<Cover>& shared) {
  const CoverFollowMeasures measures =
      value_of(use(shared, [](CoverFollower& follower) { return follower.measure(); }));
  py::dict out;
  out["solid_volume"] = measures.solid_volume;
  out["ball_volume"] = measures.ball_volume;
  return out;
}

bool covers_solid(const std::shared_ptr<Cover>& shared) {
  return value_of(
      use(shared, [](CoverFollower& follower) -> Result<bool> { return follower.state() == CoverState::kSolid; }));
}

void tighten(const std::shared_ptr<Cover>& shared) {
  require(use(shared, [](CoverFollower& follower) { return follower.tighten(); }));
}

}  // namespace

void bind_following(py::module_& module) {
  py::class_<Inside, std::shared_ptr<Inside>>(module, "Follower")
      .def("update", &update<Follower>)
      .def("present", &present<Follower>)
      .def("reset", &reset<Follower>)
      .def("measure", &measure_inside);
  py::class_<Cover, std::shared_ptr<Cover>>(module, "CoverFollower")
      .def("update", &update<CoverFollower>)
      .def("present", &present<CoverFollower>)
      .def("reset", &reset<CoverFollower>)
      .def("measure", &measure_cover)
      .def("covers_solid", &covers_solid)
      .def("tighten", &tighten);
  module.def("make_follower", &make_inside);
  module.def("make_cover_follower", &make_cover);
}

}  // namespace medial_vk::python
