// The least distance among the links of an assembly.
#include <pybind11/stl.h>

#include "medial_vk/body_group.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// Fewer configurations are answered on the calling thread.
constexpr std::size_t kFewConfigurations = 2;

/// The results of configurations one after the other, from any of which another query can start.
struct LeastDistancesHandle {
  std::vector<LeastDistance> results;
};

std::shared_ptr<BodyGroup> make_group(const std::vector<std::shared_ptr<Body>>& bodies, py::handle link_of,
                                      const py::object& pose_array, std::size_t links, py::handle pair_array) {
  const std::vector<std::uint32_t> of = indices_of(link_of, "links");
  if (of.size() != bodies.size()) fail_usage("there are not as many `links` as `bodies`");
  std::vector<Pose> poses(bodies.size());
  if (!pose_array.is_none()) poses = poses_of(pose_array, "poses");
  if (poses.size() != bodies.size()) fail_usage("there are not as many `poses` as `bodies`");
  std::vector<GroupPart> parts;
  parts.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i] == nullptr) fail_usage("one of `bodies` is None");
    parts.push_back({*bodies[i], of[i], poses[i]});
  }
  std::vector<LinkPair> pairs;
  for (const auto& [a, b] : index_pairs_of(pair_array, "pairs")) pairs.push_back({a, b});
  return std::make_shared<BodyGroup>(
      value_of(run([parts, links, pairs] { return BodyGroup::create(parts, links, pairs); })));
}

GroupOptions group_options(py::dict values, unsigned& threads) {
  GroupOptions made;
  Options options(std::move(values));
  options.read("exact", made.exact);
  options.read("tolerance", made.tolerance);
  options.read("limit", made.limit);
  options.read("threads", threads);
  options.finish();
  return made;
}

/// What a call reads and writes, which it may leave before its work ends.
struct GroupQueries {
  std::vector<Pose> poses;
  std::vector<LeastDistance> results;
};

Status find_least(const BodyGroup& group, GroupQueries& queries, const GroupOptions& options,
                  const LeastDistance& start, unsigned threads, const std::stop_token& stop) {
  if (queries.results.size() != 1) {
    return least_distances(group, queries.poses, queries.results, options, {.threads = threads}, stop);
  }
  Result<LeastDistance> one = least_distance(group, queries.poses, options, start, stop);
  if (!one) return one.error();
  queries.results[0] = one.value();
  return {};
}

/// Of configurations, each with a pose for each link. `start`: of an earlier query, whose last result is taken, or
/// None.
std::shared_ptr<LeastDistancesHandle> find_least_distances(const std::shared_ptr<BodyGroup>& group, py::handle array,
                                                           std::size_t configurations, py::dict values,
                                                           const std::shared_ptr<LeastDistancesHandle>& start) {
  const auto queries = std::make_shared<GroupQueries>();
  queries->poses = poses_of(array, "poses");
  queries->results.resize(configurations);
  unsigned threads = 0;
  const GroupOptions options = group_options(std::move(values), threads);
  LeastDistance from;
  if (start != nullptr && !start->results.empty()) from = start->results.back();
  const auto call = std::make_shared<Call>();
  require(run_unless_short(configurations < kFewConfigurations, call, [group, queries, options, from, threads, call] {
    return find_least(*group, *queries, options, from, threads, call->token());
  }));
  return std::make_shared<LeastDistancesHandle>(LeastDistancesHandle{std::move(queries->results)});
}

std::int64_t number_of(std::uint32_t index) { return index == PartPair::kNone ? -1 : std::int64_t{index}; }

py::dict least_dict(const LeastDistancesHandle& handle) {
  const std::vector<LeastDistance>& results = handle.results;
  py::dict out;
  out["lower"] = column(results, [](const LeastDistance& at) { return at.lower; });
  out["upper"] = column(results, [](const LeastDistance& at) { return at.upper; });
  out["verdicts"] = column(results, [](const LeastDistance& at) { return static_cast<std::uint8_t>(at.collision()); });
  out["lower_pairs"] = column(results, [](const LeastDistance& at) {
    return std::array{number_of(at.lower_pair.a), number_of(at.lower_pair.b)};
  });
  out["upper_pairs"] = column(results, [](const LeastDistance& at) {
    return std::array{number_of(at.upper_pair.a), number_of(at.upper_pair.b)};
  });
  return out;
}

}  // namespace

void bind_body_groups(py::module_& module) {
  py::class_<BodyGroup, std::shared_ptr<BodyGroup>>(module, "BodyGroup")
      .def("sizes",
           [](const BodyGroup& group) {
             return py::make_tuple(group.parts().size(), group.links(), group.pairs().size());
           })
      .def("least_distances", &find_least_distances);
  py::class_<LeastDistancesHandle, std::shared_ptr<LeastDistancesHandle>>(module, "LeastDistances")
      .def("results", &least_dict);
  module.def("make_group", &make_group);
}

}  // namespace medial_vk::python
