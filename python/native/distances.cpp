#include <pybind11/stl.h>

#include <atomic>
#include <thread>

#include "medial_vk/collisions.h"
#include "medial_vk/nearest_bodies.h"
#include "medial_vk/penetration.h"
#include "medial_vk/proximity.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// Fewer poses are answered on the calling thread: a thread of its own would take longer than the work.
constexpr std::size_t kFewPoses = 16;
/// Poses whose bounds take some milliseconds.
constexpr std::size_t kBlock = 4096;
/// Poses whose verdicts do, where triangles decide.
constexpr std::size_t kBlockOfTriangles = 128;

std::shared_ptr<Body> body_of_mesh(const MeshHandle& mesh, py::handle inside_centres, py::handle inside_radii,
                                   py::handle cover_centres, py::handle cover_radii, unsigned threads) {
  const std::vector<Ball> inside = balls_of(inside_centres, inside_radii);
  const std::vector<Ball> cover = balls_of(cover_centres, cover_radii);
  const auto call = std::make_shared<Call>();
  return std::make_shared<Body>(value_of(run(call, [mesh = mesh.mesh, inside, cover, threads, call] {
    return Body::create(mesh, inside, cover, {.threads = threads}, {}, call->token());
  })));
}

std::shared_ptr<Body> body_of_balls(py::handle inside_centres, py::handle inside_radii, py::handle cover_centres,
                                    py::handle cover_radii) {
  return std::make_shared<Body>(
      value_of(run([inside = balls_of(inside_centres, inside_radii), cover = balls_of(cover_centres, cover_radii)] {
        return Body::create(inside, cover);
      })));
}

py::tuple sizes(const Body& body) { return py::make_tuple(body.has_mesh(), body.inside().size(), body.cover().size()); }

std::int64_t index_of(std::uint32_t index) { return index == BallPair::kNone ? -1 : std::int64_t{index}; }

template <class Results>
auto states(const Results& results) {
  return column(results, [](const auto& result) { return static_cast<std::uint8_t>(result.collision()); });
}

py::array_t<std::int64_t> pairs(const std::vector<DistanceBounds>& results, BallPair DistanceBounds::*pair) {
  return column(results, [pair](const DistanceBounds& result) {
    return std::array{index_of((result.*pair).a), index_of((result.*pair).b)};
  });
}

/// Of a call for one pose.
Pose only_pose(py::handle array) {
  const std::vector<Pose> poses = poses_of(array, "poses");
  if (poses.size() != 1) fail_usage("one pose is expected");
  return poses.front();
}

py::tuple pair_tuple(const BallPair& pair) { return py::make_tuple(index_of(pair.a), index_of(pair.b)); }

/// Two indices, of which negative ones are none; other numbers are none, too.
BallPair pair_of(const py::handle& pair) {
  const auto number = [](std::int64_t i) {
    return i < 0 || i >= BallPair::kNone ? BallPair::kNone : static_cast<std::uint32_t>(i);
  };
  try {
    const auto [a, b] = pair.cast<std::pair<std::int64_t, std::int64_t>>();
    return {number(a), number(b)};
  } catch (const py::cast_error&) {
    fail_usage("`start` is no result for one pose");
  }
}

/// `start`: the pairs of covers and of balls inside of an earlier result, or None.
py::dict bounds_of_one(const std::shared_ptr<Body>& a, const std::shared_ptr<Body>& b, py::handle array,
                       const py::object& start) {
  const Pose pose = only_pose(array);
  DistanceBounds from;
  if (!start.is_none()) {
    const auto pairs = start.cast<py::tuple>();
    from.cover_pair = pair_of(pairs[0]);
    from.inside_pair = pair_of(pairs[1]);
  }
  const DistanceBounds result = run_here([&] { return distance_bounds(*a, *b, pose, from); });
  py::dict out;
  out["lower"] = result.lower;
  out["upper"] = result.upper;
  out["verdicts"] = static_cast<int>(result.collision());
  out["cover_pairs"] = pair_tuple(result.cover_pair);
  out["inside_pairs"] = pair_tuple(result.inside_pair);
  return out;
}

/// Poses and the results of a call, which may end before its work does.
template <class T>
struct Batch {
  explicit Batch(std::vector<Pose> of) : poses(std::move(of)), results(poses.size()) {}

  std::vector<Pose> poses;
  std::vector<T> results;
};

/// work(poses, results) for consecutive blocks, since searches by balls cannot be stopped; here, if there are few
/// poses.
template <class T, class Work>
std::vector<T> in_blocks(std::vector<Pose> poses, std::size_t block, Work work) {
  const auto batch = std::make_shared<Batch<T>>(std::move(poses));
  const auto call = std::make_shared<Call>();
  const std::size_t count = batch->poses.size();
  require(run_unless_short(count <= kFewPoses, call, [call, batch, block, count, work]() -> Status {
    for (std::size_t begin = 0; begin < count; begin += block) {
      if (call->token().stop_requested()) return Error{ErrorCode::kInterrupted, "stopped"};
      const std::size_t size = std::min(block, count - begin);
      work(std::span<const Pose>(batch->poses).subspan(begin, size), std::span(batch->results).subspan(begin, size));
    }
    return {};
  }));
  return std::move(batch->results);
}

py::dict bounds(const std::shared_ptr<Body>& a, const std::shared_ptr<Body>& b, py::handle array, unsigned threads) {
  const std::vector<DistanceBounds> results = in_blocks<DistanceBounds>(
      poses_of(array, "poses"), kBlock, [a, b, threads](std::span<const Pose> poses, std::span<DistanceBounds> found) {
        distance_bounds(*a, *b, poses, found, {.threads = threads});
      });
  py::dict out;
  out["lower"] = column(results, [](const DistanceBounds& result) { return result.lower; });
  out["upper"] = column(results, [](const DistanceBounds& result) { return result.upper; });
  out["verdicts"] = states(results);
  out["cover_pairs"] = pairs(results, &DistanceBounds::cover_pair);
  out["inside_pairs"] = pairs(results, &DistanceBounds::inside_pair);
  return out;
}

DistanceOptions distance_options(py::dict values, unsigned& threads) {
  DistanceOptions made;
  Options options(std::move(values));
  options.read("tolerance", made.tolerance);
  options.read("limit", made.limit);
  options.read("surfaces_only", made.surfaces_only);
  options.read("threads", threads);
  options.finish();
  return made;
}

py::dict exact(const std::shared_ptr<Body>& a, const std::shared_ptr<Body>& b, py::handle array, py::dict values) {
  const auto batch = std::make_shared<Batch<Distance>>(poses_of(array, "poses"));
  unsigned threads = 0;
  const DistanceOptions options = distance_options(std::move(values), threads);
  const auto call = std::make_shared<Call>();
  require(run(call, [a, b, batch, options, threads, call] {
    return distances(*a, *b, batch->poses, batch->results, options, {.threads = threads}, call->token());
  }));
  const std::vector<Distance>& results = batch->results;
  py::dict out;
  out["lower"] = column(results, [](const Distance& result) { return result.lower; });
  out["upper"] = column(results, [](const Distance& result) { return result.upper; });
  out["verdicts"] = states(results);
  out["on_a"] = column(results, [](const Distance& result) { return result.on_a; });
  out["on_b"] = column(results, [](const Distance& result) { return result.on_b; });
  out["triangles"] = column(results, [](const Distance& result) {
    return std::array{index_of(result.triangle_a), index_of(result.triangle_b)};
  });
  return out;
}

/// `start`: the triangles of an earlier result, or None.
py::dict exact_of_one(const std::shared_ptr<Body>& a, const std::shared_ptr<Body>& b, py::handle array, py::dict values,
                      const py::object& start) {
  const Pose pose = only_pose(array);
  unsigned threads = 0;
  const DistanceOptions options = distance_options(std::move(values), threads);
  Distance from;
  if (!start.is_none()) {
    const BallPair triangles = pair_of(start);
    from.triangle_a = triangles.a;
    from.triangle_b = triangles.b;
  }
  const Distance result = value_of(run_here([&] { return distance(*a, *b, pose, options, from); }));
  py::dict out;
  out["lower"] = result.lower;
  out["upper"] = result.upper;
  out["verdicts"] = static_cast<int>(result.collision());
  out["on_a"] = array_of(result.on_a);
  out["on_b"] = array_of(result.on_b);
  out["triangles"] = py::make_tuple(index_of(result.triangle_a), index_of(result.triangle_b));
  return out;
}

/// Where balls have not decided: one pose after the other on each of the threads.
void decide_by_triangles(const Body& a, const Body& b, std::span<const Pose> poses, std::span<Collision> found,
                         unsigned threads) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < poses.size(); i = next++) {
      if (found[i] == Collision::kUndecided) found[i] = collide(a, b, poses[i]);
    }
  };
  const auto undecided = static_cast<std::size_t>(std::ranges::count(found, Collision::kUndecided));
  const std::size_t most = threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < std::min(most, undecided); ++i) others.emplace_back(work);
  work();
}

py::array_t<std::uint8_t> verdicts(const std::shared_ptr<Body>& a, const std::shared_ptr<Body>& b, py::handle array,
                                   bool by_balls, unsigned threads) {
  const std::size_t block = by_balls ? kBlock : kBlockOfTriangles;
  const std::vector<Collision> results =
      in_blocks<Collision>(poses_of(array, "poses"), block,
                           [a, b, by_balls, threads](std::span<const Pose> poses, std::span<Collision> found) {
                             collide_by_balls(*a, *b, poses, found, {.threads = threads});
                             if (!by_balls) decide_by_triangles(*a, *b, poses, found, threads);
                           });
  return column(results, [](Collision verdict) { return static_cast<std::uint8_t>(verdict); });
}

py::dict depth(const std::shared_ptr<Body>& a, const std::shared_ptr<Body>& b, py::handle array, py::dict values) {
  const Pose pose = only_pose(array);
  PenetrationOptions made;
  Options options(std::move(values));
  options.read("directions", made.directions);
  options.read("most_queries", made.most_queries);
  options.read("volume_tolerance", made.volume_tolerance);
  options.read("most_columns", made.most_columns);
  options.finish();
  const Penetration result = value_of(run([a, b, pose, made] { return penetration(*a, *b, pose, made); }));
  py::dict out;
  out["depth"] = py::make_tuple(result.depth_lower, result.depth_upper);
  out["translation"] = array_of(result.translation);
  out["common_volume_lower"] = result.common_volume_lower;
  out["common_volume_of_balls"] = result.common_volume_of_balls;
  out["deepest"] = py::make_tuple(index_of(result.deepest.a), index_of(result.deepest.b));
  return out;
}

py::dict contact(const std::shared_ptr<Body>& a, const std::shared_ptr<Body>& b, py::handle start, py::handle end,
                 py::handle pivot, py::dict values) {
  const Motion motion = {only_pose(start), only_pose(end), point_of(pivot, "pivot")};
  ContactOptions made;
  Options options(std::move(values));
  options.read("clearance", made.clearance);
  options.read("tolerance", made.tolerance);
  options.read("surfaces_only", made.surfaces_only);
  options.finish();
  const auto call = std::make_shared<Call>();
  const FirstContact result =
      value_of(run(call, [a, b, motion, made, call] { return first_contact(*a, *b, motion, made, call->token()); }));
  py::dict out;
  out["free_until"] = result.free_until;
  out["contact_at"] = result.contact_at;
  out["state"] = static_cast<std::uint8_t>(result.collision());
  out["distance"] = py::make_tuple(result.nearest.lower, result.nearest.upper);
  out["on_a"] = array_of(result.nearest.on_a);
  out["on_b"] = array_of(result.nearest.on_b);
  return out;
}

std::shared_ptr<PlacedBodies> place(const std::vector<std::shared_ptr<Body>>& bodies, py::handle array) {
  const std::vector<Pose> poses = poses_of(array, "poses");
  if (poses.size() != bodies.size()) fail_usage("there are not as many `poses` as `bodies`");
  std::vector<PlacedBody> placed;
  placed.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i] == nullptr) fail_usage("one of `bodies` is None");
    placed.push_back({*bodies[i], poses[i]});
  }
  return std::make_shared<PlacedBodies>(value_of(run_unless_short(placed.size() <= kFewPoses, std::make_shared<Call>(),
                                                                  [placed] { return PlacedBodies::create(placed); })));
}

py::dict nearest(const std::shared_ptr<PlacedBodies>& among, const std::shared_ptr<Body>& body, py::handle array,
                 py::dict values) {
  const Pose pose = only_pose(array);
  NearestBodiesOptions made;
  Options options(std::move(values));
  options.read("count", made.count);
  options.read("limit", made.limit);
  options.read("by_triangles", made.by_triangles);
  options.read("tolerance", made.tolerance);
  options.finish();
  const NearBodies found =
      value_of(run([among, body, pose, made] { return nearest_bodies(*among, *body, pose, made); }));
  py::dict out;
  out["indices"] = column(found.bodies, [](const NearBody& near) { return static_cast<std::int64_t>(near.index); });
  out["lower"] = column(found.bodies, [](const NearBody& near) { return near.lower; });
  out["upper"] = column(found.bodies, [](const NearBody& near) { return near.upper; });
  out["others"] = found.others;
  return out;
}

}  // namespace

void bind_distances(py::module_& module) {
  py::class_<Body, std::shared_ptr<Body>>(module, "Body")
      .def("sizes", &sizes)
      .def("inside", [](const Body& body) { return balls_dict(body.inside()); })
      .def("cover", [](const Body& body) { return balls_dict(body.cover()); });
  py::class_<PlacedBodies, std::shared_ptr<PlacedBodies>>(module, "PlacedBodies")
      .def("size", &PlacedBodies::size)
      .def("nearest", &nearest);
  module.def("place_bodies", &place);
  module.def("body_of_mesh", &body_of_mesh);
  module.def("body_of_balls", &body_of_balls);
  module.def("distance_bounds", &bounds);
  module.def("distance_bounds_of_one", &bounds_of_one);
  module.def("distances", &exact);
  module.def("distance_of_one", &exact_of_one);
  module.def("collide", &verdicts);
  module.def("penetration", &depth);
  module.def("first_contact", &contact);
}

}  // namespace medial_vk::python
