#include "cli/clearance/robot_and_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "body_files/body_file.h"
#include "cli/shared/load.h"
#include "cli/shared/load_body.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "input/text_scanner.h"
#include "robots/find_mesh.h"
#include "robots/model/link_pairs.h"
#include "robots/model/read_urdf.h"

namespace medial_vk::cli {
namespace {

PrepareOptions prepare_options(const ClearanceOptions& options) {
  return {.keep_inner_faces = options.keep_inner_faces, .threads = options.threads, .keep_outer_faces = true};
}

Status load_robot(const ClearanceOptions& options, RobotAndScene& all) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Result<Robot> robot = read_urdf_file(options.robot, UrdfDetail::kMotion);
  if (!robot) return robot.error();
  all.robot = std::move(robot).value();
  const Result<MeshPlaces> places = mesh_places(options.robot, options.packages);
  if (!places) return places.error();
  Result<LinkSolids> solids =
      load_link_solids(all.robot, options.visual, places.value(), options.robot, prepare_options(options));
  if (!solids) return solids.error();
  all.solids = std::move(solids).value();
  for (const Link& link : all.robot.links) all.names.push_back(link.name);
  return {};
}

/// `name` is that of a file of the scene.
void add_scene(const IndexedMesh& mesh, const std::string& name, RobotAndScene& all) {
  const LinkSolid solid = {mesh, static_cast<std::uint32_t>(all.robot.links.size()), {}, name};
  all.solids.around.push_back(solid);
  all.solids.inside.push_back(solid);
  all.names.push_back(name);
}

Status load_scene_body(const std::string& path, const ClearanceOptions& options, RobotAndScene& all,
                       std::vector<StageTime>& times) {
  const Result<BodyFile> file = [&]() -> Result<BodyFile> {
    const EndAtOnce guard;  // a pipe may wait
    if (interrupted()) return stopped();
    return read_body_file(path);
  }();
  if (!file) return file.error();
  Result<LoadedBody> body = load_body(file.value(), path, options.threads, times);
  if (!body) return body.error();
  if (options.balls > 0 && body.value().cover.empty()) {
    return file_error(path, "the file has no balls that cover the mesh, and --balls needs them");
  }
  all.balls_of_files[static_cast<std::uint32_t>(all.names.size())] = {std::move(body.value().inside),
                                                                      std::move(body.value().cover)};
  add_scene(body.value().mesh, path, all);
  return {};
}

Status load_scene(const std::string& path, const ClearanceOptions& options, RobotAndScene& all,
                  std::vector<StageTime>& times) {
  if (is_body_file(path)) return load_scene_body(path, options, all, times);
  Result<std::vector<ScenePart>> read = read_meshes(path, false, times);
  if (!read) return read.error();
  const DeviceOpening no_device;
  Result<PreparedMesh> prepared =
      prepare_loaded(std::move(read.value().front().mesh), path, no_device, prepare_options(options), times);
  if (!prepared) return prepared.error();
  const Result<IndexedMesh> mesh = IndexedMesh::build(std::move(prepared).value(), {.threads = options.threads});
  if (!mesh) return mesh.error();
  add_scene(mesh.value(), path == "-" ? "stdin" : path, all);
  return {};
}

std::vector<bool> links_with_solids(const RobotAndScene& all) {
  std::vector<bool> has_solid(all.links(), false);
  for (const LinkSolid& solid : all.solids.around) has_solid[solid.link] = true;
  return has_solid;
}

/// All pairs of links but those of `left_out`, which are sorted.
std::vector<LinkPair> pairs_without(std::span<const LinkPair> pairs, std::span<const LinkPair> left_out) {
  std::vector<LinkPair> rest;
  for (const LinkPair& pair : pairs) {
    if (std::ranges::find(left_out, pair) == left_out.end()) rest.push_back(pair);
  }
  return rest;
}

Status read_left_out(const ClearanceOptions& options, RobotAndScene& all) {
  const Result<std::string> bytes = read_urdf_bytes(options.srdf);
  if (!bytes) return bytes.error();
  Result<std::vector<LinkPair>> pairs = read_srdf(bytes.value(), options.srdf, all.robot);
  if (!pairs) return pairs.error();
  all.from_srdf = std::move(pairs).value();
  return {};
}

}  // namespace

std::uint32_t RobotAndScene::owner_of(std::size_t solid) const {
  const std::size_t of_links = solids.around.size() - files();
  if (solid < of_links) return solids.around[solid].link;
  return static_cast<std::uint32_t>(robot.links.size() + (solid - of_links));
}

Result<RobotAndScene> load_robot_and_scene(const ClearanceOptions& options, std::vector<StageTime>& times) {
  Stopwatch stopwatch;
  RobotAndScene all;
  if (Status status = load_robot(options, all); !status) return status.error();
  times.push_back({"read", stopwatch.lap()});
  for (const std::string& path : options.scenes) {
    if (Status status = load_scene(path, options, all, times); !status) return status.error();
  }
  return all;
}

Status find_pairs(const ClearanceOptions& options, const Kinematics& kinematics, std::span<const GroupPart> parts,
                  RobotAndScene& all, const ProgressCallback& progress, const std::stop_token& stop) {
  const std::vector<bool> has_solid = links_with_solids(all);
  ChosenPairs chosen = choose_pairs(all.robot, has_solid);
  if (options.srdf.empty()) {
    Result<std::vector<LinkPair>> touching = find_always_touching(kinematics, parts, chosen.compared, progress, stop);
    if (!touching && touching.error().code == ErrorCode::kInvalidMesh) {
      return file_error(options.robot, fmt::format("within the limits of the joints, {}", touching.error().message));
    }
    if (!touching) return touching.error();
    all.joined = std::move(chosen.joined);
    all.touching = std::move(touching).value();
    all.pairs = pairs_without(chosen.compared, all.touching);
  } else {
    if (Status status = read_left_out(options, all); !status) return status;
    chosen.compared.insert(chosen.compared.end(), chosen.joined.begin(), chosen.joined.end());
    all.pairs = pairs_without(chosen.compared, all.from_srdf);
  }
  const std::vector<bool> moves = moving_links(all.robot);
  if (all.files() == 0) return {};
  const auto scene = static_cast<std::uint32_t>(moves.size());
  for (std::uint32_t link = 0; link < scene; ++link) {
    if (moves[link] && has_solid[link]) all.pairs.push_back({link, scene});
  }
  return {};
}

std::string encode_left_out(const RobotAndScene& all) {
  const ReasonedPairs left_out[] = {{"Adjacent", all.joined}, {"Always", all.touching}, {"User", all.from_srdf}};
  return encode_srdf(all.robot, left_out);
}

}  // namespace medial_vk::cli
